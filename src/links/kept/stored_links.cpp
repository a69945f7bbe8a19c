#include "links/kept/stored_links.h"

#include <algorithm>
#include <cmath>

#include "base/core/error.h"
#include "links/direct/direct.h"

namespace lumel {
namespace {

[[noreturn]] void fail_other_scene(const Scene& scene)
{
    throw Error(ErrorKind::input, scene.path,
                "has other surfaces than its stored links; bake the scene again");
}

/// Bits of StoredLinks::inner.
constexpr std::uint8_t kInnerFront = 1, kInnerBack = 2;

constexpr LinkEnd kToTrace{LinkNumbers::kNear << LinkEnd::kCellBits};

/// [numbers of kept] New number of each end of a link.
std::vector<std::uint32_t> numbers_now(const StoredLinks& kept, const Renumbering& now)
{
    const LinkNumbers before = kept.numbers(), after(now.instances_now, now.lumels_now);
    std::vector<std::uint32_t> numbers(before.count(), LinkNumbers::kNear);
    numbers[LinkNumbers::kBelow] = LinkNumbers::kBelow;
    numbers[LinkNumbers::kSky] = LinkNumbers::kSky;
    for (std::uint32_t i = 0; i < now.instances.size(); ++i)
        if (const std::uint32_t to = now.instances[i]; to != Renumbering::kNotThere) {
            numbers[before.black_on(i)] = after.black_on(to);
            numbers[before.lost_on(i)] = after.lost_on(to);
        }
    for (std::uint32_t i = 0; i < now.lumels.size(); ++i)
        if (now.lumels[i] != Renumbering::kNotThere)
            numbers[before.of_part(i)] = after.of_part(now.lumels[i]);
    return numbers;
}

StoredLinks::Round renumbered(const StoredLinks::Round& round, const Renumbering& now,
                              const std::vector<std::uint32_t>& numbers)
{
    const auto usual = std::uint16_t(std::lround(round.mean));
    StoredLinks::Round result{.mean = round.mean};
    for (std::size_t k = 0; k < kSolutions; ++k) {
        result.rays[k].assign(now.lumels_now, usual);
        for (std::size_t i = 0; i < now.lumels.size(); ++i)
            if (now.lumels[i] != Renumbering::kNotThere)
                result.rays[k][now.lumels[i]] = round.rays[k][i];
        const std::vector<std::size_t> from = first_rays(round.rays[k]),
                                       to = first_rays(result.rays[k]);
        result.ends[k].assign(to.back(), kToTrace);
        for (std::size_t i = 0; i < now.lumels.size(); ++i)
            for (std::size_t n = 0; now.lumels[i] != Renumbering::kNotThere && n < round.rays[k][i];
                 ++n) {
                const LinkEnd end = round.ends[k][from[i] + n];
                const std::uint32_t number = numbers[end.number()];
                result.ends[k][to[now.lumels[i]] + n] =
                    number == LinkNumbers::kNear ? kToTrace : LinkEnd::of(number, end.cell());
            }
    }
    return result;
}

StoredLinks::Pass renumbered(const StoredLinks::Pass& pass, const Renumbering& now)
{
    StoredLinks::Pass result{pass.rounds, pass.aim, pass.before,
                             std::vector<std::uint8_t>(now.lumels_now, 0)};
    for (std::size_t i = 0; i < now.lumels.size(); ++i)
        if (now.lumels[i] != Renumbering::kNotThere)
            result.levels[now.lumels[i]] = pass.levels[i];
    return result;
}

}  // namespace

bool StoredLinks::Pass::fits(std::size_t count, std::size_t most) const
{
    return aim <= ErrorOf::chart && rounds <= most && levels.size() == count &&
           std::ranges::all_of(
               levels, [](std::uint8_t level) { return level <= DirectEstimator::kMaxLevel; });
}

std::uint64_t StoredLinks::shots() const
{
    double rays = 0.0;
    for (const Round& round : rounds)
        rays += std::round(kSolutions * round.mean);
    return std::uint64_t(rays);
}

std::vector<std::size_t> first_rays(const std::vector<std::uint16_t>& rays)
{
    std::vector<std::size_t> first(rays.size() + 1, 0);
    for (std::size_t i = 0; i < rays.size(); ++i)
        first[i + 1] = first[i] + rays[i];
    return first;
}

StoredLinks renumbered(const StoredLinks& kept, const Renumbering& now)
{
    StoredLinks result{.scene_hash = kept.scene_hash,
                       .seed = kept.seed,
                       .shared_directions = kept.shared_directions,
                       .ray_offset = kept.ray_offset,
                       .lumels = std::vector<std::uint64_t>(now.lumels_now, 0),
                       .instances = std::vector<std::uint64_t>(now.instances_now, 0),
                       .boxes = std::vector<Box>(now.instances_now)};
    result.reordered = now.instances.size() != now.instances_now;
    for (std::size_t i = 0; i < now.instances.size(); ++i)
        result.reordered = result.reordered || now.instances[i] != i;
    for (std::size_t i = 0; i < now.instances.size(); ++i)
        if (const std::uint32_t to = now.instances[i]; to != Renumbering::kNotThere) {
            result.instances[to] = kept.instances[i];
            result.boxes[to] = kept.boxes[i];
        } else {
            result.gone.push_back(kept.boxes[i]);
        }
    if (!kept.guide.empty())
        result.guide = {std::vector<std::uint32_t>(now.lumels_now, 0), kept.guide.tables};
    for (std::size_t i = 0; i < now.lumels.size(); ++i)
        if (const std::uint32_t to = now.lumels[i]; to != Renumbering::kNotThere) {
            result.lumels[to] = kept.lumels[i];
            if (!kept.guide.empty())
                result.guide.group[to] = kept.guide.group[i];
        }
    const std::vector<std::uint32_t> numbers = numbers_now(kept, now);
    for (const StoredLinks::Round& round : kept.rounds)
        result.rounds.push_back(renumbered(round, now, numbers));
    for (const StoredLinks::Pass& pass : kept.passes)
        result.passes.push_back(renumbered(pass, now));
    result.side = kept.side;
    return result;
}

void keep_places(const Atlas& atlas, StoredLinks& kept)
{
    kept.side = std::uint32_t(atlas.width);
    kept.texels_per_metre = atlas.texels_per_metre;
    kept.charts = atlas.chart_count;
    kept.back_shift = atlas.back_shift;
    kept.inner.clear();
    for (const auto& [front, back] : atlas.inner)
        kept.inner.push_back(std::uint8_t((front ? kInnerFront : 0) | (back ? kInnerBack : 0)));
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
    for (const std::uint8_t sides : kept.inner)
        atlas.inner.push_back({(sides & kInnerFront) != 0, (sides & kInnerBack) != 0});
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
