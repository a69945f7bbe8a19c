#pragma once
// A window by GLFW, with Dear ImGui on OpenGL.

#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/image.h"

struct GLFWwindow;

namespace lumel {

/// A GLFW key that was pressed, or repeated.
struct KeyPress {
    int key;
    bool control;  ///< with Ctrl
    bool again;    ///< by key repeat
};

/// Keys since the last frame, and those that are down since they were pressed with Ctrl.
struct Keys {
    std::vector<KeyPress> pressed;
    std::unordered_set<int> with_control;
};

class Screen {
public:
    /// Throws Error{device} without a display or OpenGL.
    Screen(const std::string& title, const glm::ivec2& size);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    bool is_open() const;
    void close();
    glm::ivec2 size() const;                                   ///< [pixels]
    const std::string& draws_by() const { return draws_by_; }  ///< OpenGL's name of the device
    /// Since the last frame.
    const std::vector<KeyPress>& pressed() const { return keys_.pressed; }
    /// True while it is down, unless it was pressed with Ctrl.
    bool holds(int key) const;

    /// Sets the image of texture(): display-referred, 3 or 4 channels.
    void take(const Image& picture);
    void* texture() const;
    const glm::ivec2& texture_size() const { return texture_size_; }

    /// Processes input, waiting at most `seconds` for it. Widgets can be drawn afterwards.
    void begin(double seconds);
    /// Presents the frame. read: also returns it.
    Image end(bool read);

private:
    struct Gl;

    void open(const std::string& title, const glm::ivec2& size);
    Image read() const;

    GLFWwindow* window_ = nullptr;
    std::string draws_by_;
    Keys keys_;
    std::unique_ptr<Gl> gl_;
    unsigned texture_ = 0;
    glm::ivec2 texture_size_{0};
};

}  // namespace lumel
