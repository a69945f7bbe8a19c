#pragma once
// A window on the display: GLFW gives it, Dear ImGui draws into it by OpenGL.

#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/image.h"

struct GLFWwindow;

namespace lumel {

/// A key of GLFW that was pressed, or is down long enough to be pressed again.
struct KeyPress {
    int key;
    bool control;  ///< with Ctrl
    bool again;    ///< it was down before
};

class Screen {
public:
    /// Throws Error{device} where there is no display, or no OpenGL.
    Screen(const std::string& title, const glm::ivec2& size);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    bool is_open() const;
    void close();
    glm::ivec2 size() const;                                   ///< [pixels]
    const std::string& draws_by() const { return draws_by_; }  ///< OpenGL's name of the device
    const std::vector<KeyPress>& pressed() const { return pressed_; }  ///< since the last frame
    bool holds(int key) const;                                         ///< is it down?

    /// The picture that texture() shows from now on: display-referred, 3 or 4 channels.
    void take(const Image& picture);
    void* texture() const;
    const glm::ivec2& texture_size() const { return texture_size_; }

    /// Takes what mouse and keys did, waiting up to so long for it [s]. Widgets may be drawn now.
    void begin(double seconds);
    /// Shows what was drawn. read: gives it too.
    Image end(bool read);

private:
    struct Gl;

    void open(const std::string& title, const glm::ivec2& size);
    Image read() const;

    GLFWwindow* window_ = nullptr;
    std::string draws_by_;
    std::vector<KeyPress> pressed_;
    std::unique_ptr<Gl> gl_;
    unsigned texture_ = 0;
    glm::ivec2 texture_size_{0};
};

}  // namespace lumel
