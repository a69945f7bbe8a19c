#pragma once
// Scenes and bakes by the interface for C.

#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "boxes.h"
#include "lumel/lumel_c.h"

namespace lumel::v0::test {

struct FreeScene {
    void operator()(lumel_scene* scene) const { lumel_free_scene(scene); }
};
struct FreeBaked {
    void operator()(const lumel_baked* baked) const { lumel_free_baked(baked); }
};
using ScenePointer = std::unique_ptr<lumel_scene, FreeScene>;
using BakedPointer = std::unique_ptr<const lumel_baked, FreeBaked>;

/// closed_cube() as C arrays: its floor glows, its triangles 4 and 5.
struct Cube {
    static constexpr std::uint32_t kFloor = 4;  ///< its first triangle

    SceneContent content = closed_cube({.name = "white", .base_color = {0.7f, 0.7f, 0.7f, 1}});
    std::array<lumel_material, 2> materials{
        lumel_material{.name = "white", .base_color = {0.7f, 0.7f, 0.7f, 1}},
        lumel_material{.name = "glow", .base_color = {0, 0, 0, 1}, .emitted = {100, 100, 100}}};
    std::vector<std::uint32_t> of_triangle = std::vector<std::uint32_t>(12, 0);
    lumel_mesh mesh{};
    lumel_instance instance{};

    Cube()
    {
        const Primitive& sides = content.meshes[0].primitives[0];
        of_triangle[kFloor] = of_triangle[kFloor + 1] = 1;
        mesh = {.name = "cube",
                .vertex_count = std::uint32_t(sides.positions.size()),
                .positions = sides.positions[0].data(),
                .triangle_count = 12,
                .indices = sides.indices.data(),
                .material_count = 2,
                .materials = materials.data(),
                .triangle_materials = of_triangle.data()};
        instance = {.name = "room", .mesh = &mesh};
    }
    Cube(const Cube&) = delete;

    lumel_content arrays() const { return {.instance_count = 1, .instances = &instance}; }

    /// The same for C++.
    SceneContent values() const
    {
        SceneContent same = content;
        same.materials.push_back(
            {.name = "glow", .base_color = {0, 0, 0, 1}, .emitted = {100, 100, 100}});
        Primitive& white = same.meshes[0].primitives[0];
        Primitive glow = white;
        glow.material = 1;
        const auto first = white.indices.begin() + 3 * kFloor;
        glow.indices = {first, first + 6};
        white.indices.erase(first, first + 6);
        same.meshes[0].primitives.push_back(glow);
        same.instances[0].name = "room";
        return same;
    }
};

inline constexpr std::uint8_t kNoTexel = 0;
inline constexpr std::uint32_t kRays = 12;  ///< per lumel

inline ScenePointer scene_of(const lumel_content& content)
{
    lumel_scene* scene = nullptr;
    EXPECT_EQ(lumel_make_scene(&content, &scene), LUMEL_OK) << lumel_message();
    return ScenePointer(scene);
}

inline BakedPointer baked_of(const lumel_scene* scene, const lumel_settings& settings)
{
    const lumel_baked* baked = nullptr;
    EXPECT_EQ(lumel_bake(nullptr, scene, &settings, &baked), LUMEL_OK) << lumel_message();
    return BakedPointer(baked);
}

inline void expect_refusal(lumel_result result, lumel_result wanted,
                           std::initializer_list<const char*> words)
{
    EXPECT_EQ(result, wanted);
    for (const char* word : words)
        EXPECT_NE(std::strstr(lumel_message(), word), nullptr) << lumel_message();
}

}  // namespace lumel::v0::test
