#pragma once
// UI state shared by mouse, keys and panel of the window.

#include <string>

#include <glm/glm.hpp>

#include "methods/methods.h"

namespace lumel {

/// Width of the panel, and minimum width of a window with a panel [pixels].
inline constexpr int kPanelWidth = 280, kRoomForPanel = 480;

struct UiState {
    glm::ivec2 area{1};   ///< image, at the top left of the window [pixels]
    double passed = 0.0;  ///< since the last frame [s]
    float stride = 1.0f;  ///< walking distance per second [m]
    bool changed = true;  ///< the image must be redrawn
    bool panel = true, help = false, playing = false;
    int coarse = 1;  ///< size of an image pixel in window pixels
    double light_ms = 0.0, picture_ms = 0.0, window_ms = 0.0;  ///< last frame
    std::string draws;                                         ///< renderers of image and window
    std::string message;                                       ///< last error or result
    std::string save_to = "saved";
    bool save = false, shoot = false;  ///< requested: a bake, an image
    /// Options of the next solve by links.
    int rays = 0, atlas = 0, seed = 0;
    bool solve = false;
    GivenMethod method;                   ///< other method to solve the scene by
    float error = 2.0f;                   ///< its target error [%]
    bool solve_by = false, stop = false;  ///< requested: start, stop
    std::string solving;                  ///< method and progress; empty: no solve is running
    float solved_part = 0.0f;             ///< progress of its stage

    /// Pixels of the image that fills the area.
    glm::ivec2 pixels() const { return glm::max(area / coarse, glm::ivec2(1)); }
    glm::ivec2 pixel_at(const glm::vec2& mouse) const
    {
        return glm::clamp(glm::ivec2(mouse) / coarse, glm::ivec2(0), pixels() - 1);
    }
};

}  // namespace lumel
