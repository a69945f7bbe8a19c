#pragma once
// Camera that walks and orbits.

#include <optional>

#include "scene/values/view.h"

namespace lumel {

/// Projects a point to the image, (0, 0) at its top left and (1, 1) at its bottom right; empty if
/// the point is behind the eye.
std::optional<glm::vec2> place_in_picture(const View& view, const glm::vec3& point);

class ViewCamera {
public:
    explicit ViewCamera(const View& view) : view_(view) {}

    const View& view() const { return view_; }
    glm::vec3 eye() const { return glm::vec3(view_.transform[3]); }
    glm::vec3 forward() const { return -glm::vec3(view_.transform[2]); }
    glm::vec3 up() const { return glm::vec3(view_.transform[1]); }

    void set_view(const View& view) { view_ = view; }
    void set_aspect(float aspect) { view_.aspect = aspect; }
    /// Moves the eye and keeps the direction.
    void set_eye(const glm::vec3& eye) { view_.transform[3] = glm::vec4(eye, 1.0f); }
    /// Looks at a point, upright. Throws Error{input} for the eye's own position.
    void look_at(const glm::vec3& target);
    /// Walks horizontally forward and right, and vertically up [m].
    void walk(const glm::vec3& steps);
    /// Turns left and up [rad], at most straight up or down.
    void gaze(float left, float up);
    /// Orbits a point, counter-clockwise seen from above, and up over it [rad]; the point keeps its
    /// position in the image.
    void orbit(const glm::vec3& pivot, float around, float over);

private:
    /// Azimuth about +y from -z to the left, and elevation [rad].
    glm::vec2 angles() const;
    void stand_upright(const glm::vec2& angles);

    View view_;
};

}  // namespace lumel
