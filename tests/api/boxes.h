#pragma once
// Rooms made in memory.

#include <limits>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "lumel/lumel.h"

namespace lumel::v0::test {

inline constexpr int kSize = 32;  ///< of the atlas [texels]
inline constexpr double kUntilAtRest = std::numeric_limits<double>::infinity();

/// The six sides of a cube of 2 m, seen from inside, as one mesh of one material.
SceneContent inline closed_cube(const Material& material)
{
    Primitive sides;
    const auto side = [&](const Vec3& centre, const Vec3& x, const Vec3& y) {
        const auto first = std::uint32_t(sides.positions.size());
        for (const Vec2 corner : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}}) {
            Vec3 position = centre;
            for (std::size_t c = 0; c < 3; ++c)
                position[c] += corner[0] * x[c] + corner[1] * y[c];
            sides.positions.push_back(position);
        }
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
            sides.indices.push_back(first + i);
    };
    constexpr Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    side({-1, 0, 0}, y, z);
    side({1, 0, 0}, z, y);
    side({0, -1, 0}, z, x);
    side({0, 1, 0}, x, z);
    side({0, 0, -1}, x, y);
    side({0, 0, 1}, y, x);
    SceneContent content;
    content.materials = {material};
    content.meshes = {{.name = "cube", .primitives = {sides}}};
    content.instances = {{.name = "cube"}};
    return content;
}

/// That throws nothing but an Error of this kind, whose sentence has all of `words`.
template <class Work>
void expect_error(ErrorKind kind, std::initializer_list<const char*> words, const Work& work)
{
    try {
        work();
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        for (const char* word : words)
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
                << error.what() << " does not say " << word;
    }
}

inline std::string scene_path(const std::string& name)
{
    return support::source_path("scenes/" + name + ".gltf");
}

/// Mean of green light over covered texels [lx].
inline double mean_of(const Map& map)
{
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < map.rgba.size(); i += 4)
        if (map.rgba[i + 3] > 0.0f) {
            sum += double(map.rgba[i + 1]);
            count += 1.0;
        }
    return sum / count;
}

}  // namespace lumel::v0::test
