#include "links/kept/stored_links.h"

#include <bit>

#include "base/core/error.h"

namespace lumel {
namespace {

[[noreturn]] void fail_other_scene(const Scene& scene)
{
    throw Error(ErrorKind::input, scene.path,
                "has other surfaces than its stored links; bake the scene again");
}

/// [ends of kept] New number of each end of a link.
std::vector<std::uint32_t> ends_now(const StoredLinks& kept, const Renumbering& now,
                                    std::uint32_t gone)
{
    constexpr std::uint32_t kFixed = 2;  // the sky, and absorbed
    std::vector<std::uint32_t> ends = now.lumels;
    for (std::uint32_t e = 0; e < kFixed; ++e)
        ends.push_back(std::uint32_t(now.lumels_now) + e);
    for (const std::uint32_t instance : now.instances)
        ends.push_back(instance == Renumbering::kNotThere
                           ? gone
                           : std::uint32_t(now.lumels_now) + kFixed + instance);
    for (std::size_t i = 0; i < kept.lumels.size(); ++i)
        if (ends[i] == Renumbering::kNotThere)
            ends[i] = gone;
    return ends;
}

}  // namespace

std::uint32_t side_of_rays(std::uint32_t rays)
{
    if (!is_grid(rays))
        throw Error(ErrorKind::input, std::to_string(rays) + " rays",
                    "are not a grid: use 4, 16, 64 or 256");
    return 1u << (std::countr_zero(rays) / 2);
}

StoredLinks renumbered(const StoredLinks& kept, const Renumbering& now)
{
    StoredLinks result{.scene_hash = kept.scene_hash,
                       .rays = kept.rays,
                       .seed = kept.seed,
                       .ray_offset = kept.ray_offset,
                       .lumels = std::vector<std::uint64_t>(now.lumels_now, 0),
                       .instances = std::vector<std::uint64_t>(now.instances_now, 0)};
    const std::vector<std::uint32_t> ends = ends_now(kept, now, std::uint32_t(result.gone()));
    result.links.assign(now.lumels_now * kept.rays, std::uint32_t(result.gone()));
    for (std::size_t i = 0; i < now.instances.size(); ++i)
        if (now.instances[i] != Renumbering::kNotThere)
            result.instances[now.instances[i]] = kept.instances[i];
    for (std::size_t i = 0; i < now.lumels.size(); ++i)
        if (const std::size_t j = now.lumels[i]; j != Renumbering::kNotThere) {
            result.lumels[j] = kept.lumels[i];
            for (std::size_t k = 0; k < kept.rays; ++k)
                result.links[j * kept.rays + k] = ends[kept.links[i * kept.rays + k]];
        }
    result.side = kept.side;
    return result;
}

void keep_places(const Atlas& atlas, StoredLinks& kept)
{
    kept.side = std::uint32_t(atlas.width);
    kept.texels_per_metre = atlas.texels_per_metre;
    kept.charts = atlas.chart_count;
    kept.back_shift = atlas.back_shift;
    kept.shows_front = atlas.shows_front ? 1 : 0;
    for (const Surface& surface : atlas.surfaces)
        kept.sheets.push_back({surface.texcoord, surface.chart, surface.authored ? 1u : 0u});
}

Atlas atlas_of(const StoredLinks& kept, const Scene& scene, const Pages& pages)
{
    if (pages.map_side() != int(kept.side))
        fail_other_scene(scene);
    Atlas atlas;
    atlas.pages = pages;
    atlas.width = atlas.height = int(kept.side);
    atlas.texels_per_metre = kept.texels_per_metre;
    atlas.chart_count = kept.charts;
    atlas.back_shift = kept.back_shift;
    atlas.shows_front = kept.shows_front != 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[i].mesh)];
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
            const Primitive& primitive = mesh.primitives[p];
            if (atlas.surfaces.size() == kept.sheets.size())
                fail_other_scene(scene);
            const StoredLinks::StoredTexcoords& sheet = kept.sheets[atlas.surfaces.size()];
            if (sheet.texcoord.size() != primitive.positions.size() ||
                3 * sheet.chart.size() != primitive.indices.size())
                fail_other_scene(scene);
            Surface surface{.instance = i, .primitive = p, .texcoord = sheet.texcoord};
            for (std::uint32_t v = 0; v < primitive.positions.size(); ++v)
                surface.source_vertex.push_back(v);
            surface.indices = primitive.indices;
            surface.chart = sheet.chart;
            surface.authored = sheet.authored != 0;
            atlas.surfaces.push_back(std::move(surface));
        }
    }
    if (atlas.surfaces.size() != kept.sheets.size())
        fail_other_scene(scene);
    return atlas;
}

}  // namespace lumel
