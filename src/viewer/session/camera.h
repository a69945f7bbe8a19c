#pragma once
// A camera that walks and orbits.

#include <optional>

#include "scene/values/view.h"

namespace lumel {

/// Where a picture shows a point, (0, 0) at its top left and (1, 1) at its bottom right; nothing if
/// it is not before the eye.
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
    /// Stands elsewhere and looks into the same direction.
    void set_eye(const glm::vec3& eye) { view_.transform[3] = glm::vec4(eye, 1.0f); }
    /// Looks at a point, upright. Throws Error{input} for the eye's own place.
    void look_at(const glm::vec3& target);
    /// Walks level: forward, to the right and up [m].
    void walk(const glm::vec3& steps);
    /// Turns to the left and up [rad], no farther than straight up or down.
    void gaze(float left, float up);
    /// Goes around a point, counter-clockwise as seen from above, and up over it [rad]; what is
    /// seen of the point stays where it is in the picture.
    void orbit(const glm::vec3& pivot, float around, float over);

private:
    /// Azimuth about +y from -z to the left, and elevation [rad].
    glm::vec2 angles() const;
    void stand_upright(const glm::vec2& angles);

    View view_;
};

}  // namespace lumel
