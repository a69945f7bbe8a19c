#pragma once
// Rooms made in memory.

#include <limits>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "base/core/files.h"
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

inline lumel::Bytes bytes_of(const std::string& path)
{
    return lumel::read_file(path, path);
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

/// Green light of a map under the middle of each triangle [lx], with the triangle's centre and
/// normal in the world; turned as `surface` has it.
struct LitTriangle {
    Vec3 centre, normal;
    double light;
};
inline std::vector<LitTriangle> lit_triangles(const Surface& surface, const Primitive& primitive,
                                              const Map& map)
{
    std::vector<LitTriangle> triangles;
    for (std::size_t first = 0; first < surface.indices.size(); first += 3) {
        std::array<Vec3, 3> at;
        Vec2 place{0, 0};
        Vec3 centre{0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = surface.indices[first + k];
            at[k] = primitive.positions[surface.source_vertex[v]];
            for (std::size_t c = 0; c < 2; ++c)
                place[c] += surface.lightmap[v][c] / 3.0f;
            for (std::size_t c = 0; c < 3; ++c)
                centre[c] += at[k][c] / 3.0f;
        }
        Vec3 normal;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
            normal[c] = (at[1][d] - at[0][d]) * (at[2][e] - at[0][e]) -
                        (at[1][e] - at[0][e]) * (at[2][d] - at[0][d]);
        }
        const auto x = std::size_t(place[0] * float(map.width)),
                   y = std::size_t(place[1] * float(map.height));
        triangles.push_back(
            {centre, normal, double(map.rgba.at(4 * (y * std::size_t(map.width) + x) + 1))});
    }
    return triangles;
}

/// closed_cube() of grey, double-sided paint, with a bulb in it, under a sun in the zenith.
inline constexpr float kSun = 1000.0f;  ///< [lx]
inline SceneContent paper_house(bool sun)
{
    SceneContent content = closed_cube(
        {.name = "paper", .base_color = {0.5f, 0.5f, 0.5f, 1.0f}, .double_sided = true});
    content.lights = {{.name = "bulb", .intensity = 10.0f}};
    if (sun)
        content.lights.push_back(
            {.kind = Light::Kind::directional, .name = "sun", .intensity = kSun});
    return content;
}

/// That the ceiling has the light of the bulb, as if there were no sun, and the roof that of the
/// sun. dark: light of the house without sun [lx].
inline void expect_two_sides(const std::vector<Surface>& surfaces, const Map& map,
                             const SceneContent& house, double dark)
{
    ASSERT_EQ(surfaces.size(), 2u);
    EXPECT_FALSE(surfaces[0].back);
    EXPECT_TRUE(surfaces[1].back);
    int ceilings = 0, roofs = 0;
    for (const Surface& surface : surfaces)
        for (const LitTriangle& one : lit_triangles(surface, house.meshes[0].primitives[0], map)) {
            if (one.centre[1] < 0.9f)
                continue;
            EXPECT_EQ(one.normal[1] > 0.0f, surface.back);
            if (surface.back)
                EXPECT_NEAR(one.light, double(kSun), 1e-3 * double(kSun));
            else
                EXPECT_NEAR(one.light, dark, 0.1 * dark);
            ++(surface.back ? roofs : ceilings);
        }
    EXPECT_EQ(ceilings, 2);
    EXPECT_EQ(roofs, 2);
}

/// Mean light of triangles of the ceiling.
inline double light_of_ceiling(const std::vector<Surface>& surfaces, const Map& map,
                               const SceneContent& house)
{
    double sum = 0.0;
    for (const LitTriangle& one : lit_triangles(surfaces[0], house.meshes[0].primitives[0], map))
        sum += one.centre[1] > 0.9f ? 0.5 * one.light : 0.0;
    return sum;
}

}  // namespace lumel::v0::test
