#include "live/kept_links.h"

#include <bit>

#include "core/error.h"

namespace lumel {
namespace {

[[noreturn]] void fail_other_scene(const Scene& scene)
{
    throw Error(ErrorKind::input, scene.path,
                "has other surfaces than those whose links were kept; bake the scene again");
}

}  // namespace

std::uint32_t side_of_rays(std::uint32_t rays)
{
    if (!is_grid(rays))
        throw Error(ErrorKind::input, std::to_string(rays) + " rays",
                    "are no grid: a lumel has 4, 16, 64 or 256");
    return 1u << (std::countr_zero(rays) / 2);
}

void keep_places(const Atlas& atlas, KeptLinks& kept)
{
    kept.side = std::uint32_t(atlas.width);
    kept.texels_per_metre = atlas.texels_per_metre;
    kept.charts = atlas.chart_count;
    kept.back_shift = atlas.back_shift;
    kept.shows_front = atlas.shows_front ? 1 : 0;
    for (const Surface& surface : atlas.surfaces)
        kept.sheets.push_back({surface.texcoord, surface.chart, surface.authored ? 1u : 0u});
}

Atlas atlas_of(const KeptLinks& kept, const Scene& scene, const Pages& pages)
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
            const KeptLinks::Sheet& sheet = kept.sheets[atlas.surfaces.size()];
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
