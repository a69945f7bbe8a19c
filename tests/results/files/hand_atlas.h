#pragma once
// An atlas without charts: every corner of every triangle is a vertex of its own at a place that
// identifies it. Nothing of the atlas room is needed.

#include <cstdint>
#include <numeric>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"

namespace lumel::test {

inline Atlas corner_atlas(const Scene& scene, int side = 64)
{
    Atlas atlas;
    atlas.width = side;
    atlas.height = side / 2;
    std::uint32_t serial = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[i].mesh)];
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
            Surface surface;
            surface.instance = i;
            surface.primitive = p;
            for (const std::uint32_t vertex : mesh.primitives[p].indices) {
                surface.indices.push_back(std::uint32_t(surface.source_vertex.size()));
                surface.source_vertex.push_back(vertex);
                surface.texcoord.emplace_back(float(serial % 61) * 0.97f,
                                              float(serial / 61 % 31) * 0.97f);
                ++serial;
            }
            surface.chart.assign(surface.indices.size() / 3, i);
            atlas.surfaces.push_back(std::move(surface));
        }
    }
    atlas.chart_count = std::uint32_t(scene.instances.size());
    return atlas;
}

/// The primitive that a surface of the atlas was made from.
inline const Primitive& primitive_of(const Scene& scene, const Surface& surface)
{
    const Instance& instance = scene.instances.at(surface.instance);
    return scene.meshes.at(std::size_t(instance.mesh)).primitives.at(surface.primitive);
}

/// corner_atlas() with the triangles of the file, which share vertices.
inline Atlas shared_atlas(const Scene& scene)
{
    Atlas atlas = corner_atlas(scene);
    for (Surface& surface : atlas.surfaces) {
        const Primitive& primitive = primitive_of(scene, surface);
        surface.indices = primitive.indices;
        surface.source_vertex.resize(primitive.positions.size());
        std::iota(surface.source_vertex.begin(), surface.source_vertex.end(), 0u);
        surface.texcoord.resize(primitive.positions.size());
    }
    return atlas;
}

/// A map that is covered everywhere and differs from texel to texel.
inline Image any_map(const Atlas& atlas)
{
    Image map(atlas.width, atlas.height, 4);
    for (std::size_t i = 0; i < map.values.size(); ++i)
        map.values[i] = i % 4 == 3 ? 1.0f : 1.0f + float(i % 131);
    return map;
}

}  // namespace lumel::test
