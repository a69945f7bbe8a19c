#include "jobs/edit/edited_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "atlas/lumels/sides.h"
#include "atlas/near/buried.h"
#include "atlas/prepare/lit_sides.h"
#include "jobs/edit/kept_atlas.h"
#include "scene/values/scene_hash.h"

namespace lumel {
namespace {

/// Relative differences of reflectance and emission that do not count as changes: texture
/// coordinates were rounded.
constexpr float kSameColour = 1e-4f;
/// Relative difference of area that does not count as a change.
constexpr float kSameArea = 1e-3f;

/// Scales a lumel's area to its open part; keeps its pieces.
void shrink(Lumel& lumel, float share)
{
    if (share > 0.0f)
        lumel.area *= share;
    else
        lumel.flags |= kLumelBuried;
}

/// Its texel in an atlas `side` texels wide that has grown since; empty if outside.
std::optional<std::size_t> texel_before(const Lumel& lumel, int width, int side)
{
    const int x = int(lumel.texel) % width, y = int(lumel.texel) / width;
    if (x >= side || y >= side)
        return std::nullopt;
    return std::size_t(y) * std::size_t(side) + std::size_t(x);
}

/// Lumels [N] whose burial can have changed: new, moved, or near a moved object.
std::vector<char> disturbed(const Scene& scene, const Lumels& lumels, const Matches& matches,
                            const std::vector<Ball>& balls, int side)
{
    constexpr float kReach = 2.0f;  // bounding radius of a lumel, in sizes
    std::vector<char> flags;
    for (const Lumel& lumel : lumels.lumels) {
        const glm::vec3 x(scene.instances[lumel.instance].transform *
                          glm::vec4(lumel.position, 1.0f));
        flags.push_back(matches.moved[lumel.instance] || !texel_before(lumel, lumels.width, side) ||
                        std::any_of(balls.begin(), balls.end(), [&](const Ball& ball) {
                            return glm::distance(x, ball.centre) <=
                                   ball.radius + kReach * lumel.size;
                        }));
    }
    return flags;
}

std::vector<std::uint32_t> same_lumels(const EditedScene& edit)
{
    const Lumels &before = edit.before.lumels, &now = edit.now.lumels;
    const std::vector<std::uint32_t> places = lumels_by_side(before);
    std::vector<std::uint32_t> same;
    for (const Lumel& lumel : now.lumels) {
        same.push_back(kNoLumel);
        const auto texel = texel_before(lumel, now.width, before.width);
        if (edit.matches.before[lumel.instance] == kNoInstance || !texel)
            continue;
        const std::uint32_t j = places[place_by_side(*texel, is_back(lumel))];
        if (j != kNoLumel && !is_buried(before.lumels[j]))
            same.back() = j;
    }
    return same;
}

std::vector<std::uint32_t> partners(const EditedScene& edit, std::vector<std::uint32_t> same)
{
    for (std::size_t i = 0; i < same.size(); ++i) {
        const Lumel& lumel = edit.now.lumels.lumels[i];
        if (same[i] == kNoLumel)
            continue;
        const float area = edit.before.lumels.lumels[same[i]].area;
        if (is_buried(lumel) || edit.matches.moved[lumel.instance] ||
            std::abs(lumel.area - area) > kSameArea * area)
            same[i] = kNoLumel;
    }
    return same;
}

bool is_alike(const glm::vec3& a, const glm::vec3& b, const glm::vec3& scale)
{
    return glm::all(glm::lessThanEqual(glm::abs(a - b), kSameColour * scale));
}

bool has_changed_lights(const Scene& before, const Scene& now)
{
    const auto lights_of = [](const Scene& scene) {
        Scene lights;
        lights.lights = scene.lights;
        lights.profiles = scene.profiles;
        lights.sky = scene.sky;
        return hash_scene(lights);
    };
    return lights_of(before) != lights_of(now);
}

std::uint64_t recoloured_instances(const EditedScene& edit)
{
    std::vector<char> recoloured(edit.now.scene.instances.size(), 0);
    for (std::size_t i = 0; i < edit.same.size(); ++i)
        if (edit.same[i] != kNoLumel &&
            !looks_alike(edit.now.lumels.lumels[i], edit.before.lumels.lumels[edit.same[i]]))
            recoloured[edit.now.lumels.lumels[i].instance] = 1;
    return std::uint64_t(std::count(recoloured.begin(), recoloured.end(), char(1)));
}

}  // namespace

EditedScene::EditedScene(Scene scene_before, Scene scene_now, const StoredSolution& solution,
                         const BakeRecord& baked)
    : EditedScene(
          std::move(scene_before), std::move(scene_now), solution, baked,
          [&](const Scene& scene, const RayScene&, const ProgressCallback&) {
              return written_atlas(scene, baked.pages, float(baked.texels_per_metre),
                                   solution.charts);
          },
          false)
{
}

EditedScene::EditedScene(Scene scene_before, Scene scene_now, const StoredSolution& solution,
                         const BakeRecord& baked, const SolveScene::LayOut& atlas_before)
    : EditedScene(std::move(scene_before), std::move(scene_now), solution, baked, atlas_before,
                  true)
{
}

EditedScene::EditedScene(Scene scene_before, Scene scene_now, const StoredSolution& solution,
                         const BakeRecord& baked, const SolveScene::LayOut& atlas_before,
                         bool as_a_bake)
    : before(std::move(scene_before), atlas_before,
             [&](const Scene&, const RayScene&, const Atlas&, Lumels& lumels,
                 const ProgressCallback&) { return bury_as_before(solution, lumels); }),
      matches(match_instances(before.scene, scene_now)),
      balls(changed_balls(before.scene, scene_now, matches)),
      now(
          std::move(scene_now),
          [&](const Scene& scene, const RayScene& rays, const ProgressCallback&) {
              Atlas kept =
                  kept_atlas(before.scene, before.atlas, scene, matches, baked.atlas.gutter);
              return as_a_bake ? with_inner_sides(scene, rays, std::move(kept)) : kept;
          },
          as_a_bake ? SolveScene::Bury()
                    : [&](const Scene& scene, const RayScene& rays, const Atlas& atlas,
                          Lumels& lumels, const ProgressCallback&) {
                          return bury_anew(scene, rays, atlas, solution, lumels);
                      }),
      same(same_lumels(*this)),
      partner(partners(*this, same))
{
}

// Tests only where needed: testing everywhere takes longer than all other work.
std::vector<float> EditedScene::bury_anew(const Scene& scene, const RayScene& rays,
                                          const Atlas& atlas, const StoredSolution& solution,
                                          Lumels& lumels)
{
    const std::vector<char> again = disturbed(scene, lumels, matches, balls, solution.side);
    std::vector<float> open(again.size(), 1.0f);
    if (std::ranges::find(again, 1) != again.end())
        open = mark_buried(scene, rays, with_inner_sides(scene, rays, atlas), lumels, again);
    thinned.assign(open.size(), 1.0f);
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (again[i])
            continue;
        Lumel& lumel = lumels.lumels[i];
        open[i] = solution.open_share(lumel, *texel_before(lumel, lumels.width, solution.side));
        shrink(lumel, open[i]);
        thinned[i] = open[i] > 0.0f ? open[i] : 1.0f;
    }
    return open;
}

std::vector<float> bury_as_before(const StoredSolution& solution, Lumels& lumels)
{
    std::vector<float> open;
    for (Lumel& lumel : lumels.lumels) {
        open.push_back(solution.open_share(lumel, lumel.texel));
        shrink(lumel, open.back());
    }
    return open;
}

bool looks_alike(const Lumel& a, const Lumel& b)
{
    return is_alike(a.albedo, b.albedo, glm::vec3(1.0f)) &&
           is_alike(a.emission, b.emission, glm::max(a.emission, b.emission));
}

UpdateRow changes_of(const EditedScene& edit)
{
    UpdateRow row;
    const auto is_there = [](const Scene& scene, std::size_t i) {
        return !scene.meshes[std::size_t(scene.instances[i].mesh)].primitives.empty();
    };
    for (std::size_t i = 0; i < edit.matches.before.size(); ++i)
        if (edit.matches.before[i] == kNoInstance)
            row.appeared += is_there(edit.now.scene, i);
        else
            row.moved += edit.matches.moved[i] != 0;
    for (std::size_t i = 0; i < edit.matches.after.size(); ++i)
        row.vanished += edit.matches.after[i] == kNoInstance && is_there(edit.before.scene, i);
    row.recoloured = recoloured_instances(edit);
    row.relit = has_changed_lights(edit.before.scene, edit.now.scene);
    return row;
}

}  // namespace lumel
