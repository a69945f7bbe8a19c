#pragma once
// What mouse, keys and panel of the window share.

#include <string>

#include <glm/glm.hpp>

#include "methods/methods.h"

namespace lumel {

/// Widths of the panel, and of the window that has room for it and a picture [pixels].
inline constexpr int kPanelWidth = 280, kRoomForPanel = 480;

struct UiState {
    glm::ivec2 area{1};   ///< of the picture, at the top left of the window [pixels]
    double passed = 0.0;  ///< since the last frame [s]
    float stride = 1.0f;  ///< a second's way [m]
    bool changed = true;  ///< the picture is to be made anew
    bool panel = true, help = false, playing = false;
    int coarse = 1;  ///< side of a picture's pixel in the window's
    double light_ms = 0.0, picture_ms = 0.0, window_ms = 0.0;  ///< of the last frame
    std::string draws;                                         ///< what draws picture and window
    std::string message;                                       ///< what could not be done, or was
    std::string save_to = "saved";
    bool save = false, shoot = false;  ///< asked for: a bake, a picture
    /// What the light is to be solved with, once that is asked for.
    int rays = 0, atlas = 0, seed = 0;
    bool solve = false;
    GivenMethod method;                   ///< that the scene is to be solved by besides
    float error = 2.0f;                   ///< to solve it to [%]
    bool solve_by = false, stop = false;  ///< asked for: to begin, to end it
    std::string solving;                  ///< what is being solved, and how far; empty: nothing
    float solved_part = 0.0f;             ///< of its stage

    /// Pixels of the picture that fill the area.
    glm::ivec2 pixels() const { return glm::max(area / coarse, glm::ivec2(1)); }
    glm::ivec2 pixel_at(const glm::vec2& mouse) const
    {
        return glm::clamp(glm::ivec2(mouse) / coarse, glm::ivec2(0), pixels() - 1);
    }
};

}  // namespace lumel
