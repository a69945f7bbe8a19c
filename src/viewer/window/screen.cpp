#include "viewer/window/screen.h"

#include <algorithm>
#include <cstdint>

#include <GL/gl.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr const char* kShaders = "#version 130";  ///< for OpenGL 3.0
constexpr int kMajor = 3, kMinor = 0;
constexpr glm::ivec2 kSmallest{200, 150};  ///< minimum window size [pixels]
constexpr float kByte = 255.0f;

[[noreturn]] void fail()
{
    const char* why = nullptr;
    glfwGetError(&why);
    std::string text = why ? why : "no reason is given";
    std::replace(text.begin(), text.end(), '\n', ' ');
    throw Error(ErrorKind::device, "lumel view",
                "no window can be opened (" + text +
                    "); --script FILE --headless works without one");
}

/// Loads a driver function at run time: lumel also starts without libGL.
template <class Function>
void find(Function& function, const char* name)
{
    function = reinterpret_cast<Function>(glfwGetProcAddress(name));
    if (!function)
        fail();
}

/// Also counts a key pressed and released between two frames.
void on_key(GLFWwindow* window, int key, int, int action, int with)
{
    Keys& keys = *static_cast<Keys*>(glfwGetWindowUserPointer(window));
    const bool control = (with & GLFW_MOD_CONTROL) != 0;
    if (action == GLFW_RELEASE)
        keys.with_control.erase(key);
    else
        keys.pressed.push_back({key, control, action == GLFW_REPEAT});
    if (action == GLFW_PRESS && control)
        keys.with_control.insert(key);
}

}  // namespace

struct Screen::Gl {
    decltype(&glGetString) get_string;
    decltype(&glGenTextures) gen_textures;
    decltype(&glDeleteTextures) delete_textures;
    decltype(&glBindTexture) bind_texture;
    decltype(&glTexParameteri) tex_parameter;
    decltype(&glTexImage2D) tex_image;
    decltype(&glPixelStorei) pixel_store;
    decltype(&glReadPixels) read_pixels;
    decltype(&glViewport) viewport;
    decltype(&glClear) clear;

    Gl()
    {
        find(get_string, "glGetString");
        find(gen_textures, "glGenTextures");
        find(delete_textures, "glDeleteTextures");
        find(bind_texture, "glBindTexture");
        find(tex_parameter, "glTexParameteri");
        find(tex_image, "glTexImage2D");
        find(pixel_store, "glPixelStorei");
        find(read_pixels, "glReadPixels");
        find(viewport, "glViewport");
        find(clear, "glClear");
    }
};

Screen::Screen(const std::string& title, const glm::ivec2& size)
{
    if (!glfwInit())
        fail();
    try {
        open(title, size);
    } catch (...) {
        glfwTerminate();
        throw;
    }
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // no files beside the requested ones
    ImGui::StyleColorsDark();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init(kShaders);
}

void Screen::open(const std::string& title, const glm::ivec2& size)
{
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, kMajor);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, kMinor);
    window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (!window_)
        fail();
    glfwSetWindowSizeLimits(window_, kSmallest.x, kSmallest.y, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(0);  // light has its own time budget
    gl_ = std::make_unique<Gl>();
    const GLubyte* name = gl_->get_string(GL_RENDERER);
    draws_by_ = name ? reinterpret_cast<const char*>(name) : "OpenGL";
    gl_->gen_textures(1, &texture_);
    gl_->bind_texture(GL_TEXTURE_2D, texture_);
    gl_->tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_->tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glfwSetWindowUserPointer(window_, &keys_);
    glfwSetKeyCallback(window_, on_key);
}

Screen::~Screen()
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    gl_->delete_textures(1, &texture_);
    glfwTerminate();
}

bool Screen::is_open() const
{
    return !glfwWindowShouldClose(window_);
}

void Screen::close()
{
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

glm::ivec2 Screen::size() const
{
    glm::ivec2 size;
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return glm::max(size, glm::ivec2(1));
}

bool Screen::holds(int key) const
{
    return glfwGetKey(window_, key) == GLFW_PRESS && !keys_.with_control.contains(key);
}

void Screen::take(const Image& picture)
{
    // Black where there is no surface.
    std::vector<GLubyte> bytes(picture.values.size());
    const std::size_t stride = std::size_t(picture.channels);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const float covered = stride == 4 ? picture.values[i / stride * stride + 3] : 1.0f;
        bytes[i] = GLubyte(std::clamp(covered * picture.values[i], 0.0f, 1.0f) * kByte + 0.5f);
    }
    const GLenum format = picture.channels == 4 ? GL_RGBA : GL_RGB;
    gl_->bind_texture(GL_TEXTURE_2D, texture_);
    gl_->pixel_store(GL_UNPACK_ALIGNMENT, 1);
    gl_->tex_image(GL_TEXTURE_2D, 0, GL_RGB8, picture.width, picture.height, 0, format,
                   GL_UNSIGNED_BYTE, bytes.data());
    texture_size_ = {picture.width, picture.height};
}

void* Screen::texture() const
{
    return reinterpret_cast<void*>(std::uintptr_t(texture_));
}

void Screen::begin(double seconds)
{
    keys_.pressed.clear();
    if (seconds > 0.0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

Image Screen::read() const
{
    const glm::ivec2 all = size();
    std::vector<GLubyte> bytes(std::size_t(all.x) * std::size_t(all.y) * 3);
    gl_->pixel_store(GL_PACK_ALIGNMENT, 1);
    gl_->read_pixels(0, 0, all.x, all.y, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
    Image image(all.x, all.y, 3);
    for (int y = 0; y < all.y; ++y)  // OpenGL rows start at the bottom
        for (int k = 0; k < 3 * all.x; ++k)
            image.at(0, y)[k] =
                float(bytes[std::size_t(all.y - 1 - y) * std::size_t(3 * all.x) + std::size_t(k)]) /
                kByte;
    return image;
}

Image Screen::end(bool read_too)
{
    ImGui::Render();
    const glm::ivec2 all = size();
    gl_->viewport(0, 0, all.x, all.y);
    gl_->clear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    Image seen;
    if (read_too)
        seen = read();
    glfwSwapBuffers(window_);
    return seen;
}

}  // namespace lumel
