#pragma once
// Conversion between API values and internal ones.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"
#include "lumel/lumel.h"

namespace lumel::v0 {

glm::vec2 to_glm(const Vec2& v);
glm::vec3 to_glm(const Vec3& v);
glm::vec4 to_glm(const Vec4& v);
glm::mat4 to_glm(const Mat4& m);
/// Transform in the world of the file. origin: of the scene, in that world.
Mat4 place_in_file(const glm::mat4& place, const glm::dvec3& origin);
/// Transform of the file's world in the scene's own. given: the transform that the scene has; it is
/// returned exactly for place_in_file(given), although floats are coarse far from the origin.
glm::mat4 place_in_scene(const Mat4& place, const glm::mat4& given, const glm::dvec3& origin);
template <class T>
auto to_glm(const std::vector<T>& values)
{
    std::vector<decltype(to_glm(values[0]))> result;
    result.reserve(values.size());
    for (const T& value : values)
        result.push_back(to_glm(value));
    return result;
}
Mat4 from_glm(const glm::mat4& m);

/// True if all values are finite.
template <class Array>
bool is_finite(const Array& values)
{
    return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
}

/// Throws lumel::Error{input} if a value is negative or not finite. `what`: subject of the message.
glm::vec3 checked_factor(const Vec3& factor, const std::string& what);

/// Throws lumel::Error{input} if a value is out of range.
AtlasOptions checked_options(const AtlasSettings& settings);

Map map_of(Image&& image);
std::vector<Page> pages_of(const Atlas& atlas);
std::vector<Surface> surfaces_of(const lumel::Scene& scene, const Atlas& atlas);

}  // namespace lumel::v0
