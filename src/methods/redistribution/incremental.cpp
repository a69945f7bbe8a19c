// Incremental radiosity.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 3.1, 3.2 and 4.4.
//
// Stores H = T B^s (progressive.cpp). After a move T is T', and
//
//     H' = H - T B^s + T' B^s                                              Eq. (3.2.1)
//
// restricted to the pairs that differ: those that moved, and those that moved objects came between
// or left. [Hoef13] section 3.1 names them by shooter and receiver, C static and M moved:
//
//     R(M, C)   the light of M is taken back from its old position, and sent from the new one
//     R(C, M)   M discards the light that arrived, and all is shot to it again (reshooting, Eq.
//               (4.4.1))
//     R(M, M)   as R(C, M)
//     R(C, C)   taken back with the old views, sent with the new ones: the four cases of
//               section 4.4.1 with the visibility of each
//
// T never changes, so errors do not accumulate over many moves.
//
// Differs from the thesis:
// - Visibility of patches is stored, one bit per lumel (visibility_rows.h). The thesis renders
//   two hemicubes for each patch; here the old one is needed only where nothing is stored yet, and
//   light is computed only where a bit changes.
// - Unshot light is not sent along. It is shot afterwards over the stored bits, without further
//   hemicubes (remaining_light.h).
// - Pairs whose line of sight does not cross moved objects are skipped.
//
// Patches without rows, and all if no memory is allowed for them, use the thesis' two hemicubes.

#include "methods/redistribution/incremental.h"

#include <algorithm>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Pixels by which an edge can seem to protrude: the visibility test reads pixels around a point.
constexpr float kEdgePixels = 3.0f;

/// True if all corners of the box are behind the plane through x.
bool is_behind(const MovedBox& box, const glm::vec3& x, const glm::vec3& normal, float slack)
{
    const glm::vec3 highest = glm::mix(box.low, box.high, glm::greaterThan(normal, glm::vec3(0)));
    const glm::vec3 reach = glm::max(glm::abs(box.low - x), glm::abs(box.high - x));
    return glm::dot(highest - x, normal) < -slack * glm::length(reach);
}

bool has_shot(const std::vector<glm::vec3>& shot, const Patch& patch)
{
    const auto first = shot.begin() + patch.first;
    return std::any_of(first, first + patch.count, [](auto& b) { return b != glm::vec3(0.0f); });
}

}  // namespace

bool may_see(const Move& move, const Lumels& lumels, const std::vector<glm::mat4>& places,
             const Patch& patch, float slack)
{
    const Lumel& lumel = lumels.lumels[patch.first];
    if (move.moved[lumel.instance] || (patch.count > 1 && patch.eye != kFromMean))
        return true;
    const glm::mat4& place = places[lumel.instance];
    const glm::vec3 x(place * glm::vec4(lumel.position, 1.0f));
    const glm::vec3 normal =
        glm::normalize(glm::inverse(glm::transpose(glm::mat3(place))) * lumel.normal);
    return !std::all_of(move.boxes.begin(), move.boxes.end(),
                        [&](const MovedBox& box) { return is_behind(box, x, normal, slack); });
}

float edge_slack(const EyeViewLayout& views)
{
    return kEdgePixels * 2.0f / float(views.side);
}

PairRedistribution::PairRedistribution(const gpu::Device& device, ProgressiveRadiosity& solver,
                                       std::size_t instances)
    : moved(device, instances),
      boxes(device, 1),
      receive_(device, std::uint32_t(solver.shots().views().projection()))
{
}

void PairRedistribution::receive(const char* stage, const World& world,
                                 ProgressiveRadiosity& solver, const ShotList& list,
                                 std::uint32_t first, float sign, VisibilityRows& rows, bool keeps,
                                 gpu::Array<glm::vec3>& received)
{
    const PatchShots& shots = solver.shots();
    const EyeViews& views = shots.views();
    solver.pacer().dispatch_parts(stage, std::uint32_t(world.lumels().size()), kProbeLumels,
                                  receive_,
                                  {.lumels = world.lumels(),
                                   .pieces = world.pieces(),
                                   .views = {views.image(), views.sampler()},
                                   .eyes = shots.eyes(),
                                   .shots = shots.shots(),
                                   .sending = shots.sending(),
                                   .row_of = list.rows,
                                   .seen = rows.seen(),
                                   .far = received,
                                   .moved = moved,
                                   .boxes = boxes},
                                  {.batch = rows.batch(first, sign),
                                   .boxes = std::uint32_t(boxes.size()),
                                   .slack = edge_slack(views.layout()),
                                   .keeps = keeps ? 1u : 0u});
}

IncrementalRedistribution::IncrementalRedistribution(const gpu::Device& device, World& world,
                                                     const Lumels& lumels,
                                                     ProgressiveRadiosity& solver,
                                                     VisibilityRows& rows)
    : device_(&device),
      world_(&world),
      lumels_(&lumels),
      solver_(&solver),
      rows_(&rows),
      pairs_(device, solver, world.placements().size()),
      reset_(device),
      phases_(rows)
{
}

bool IncrementalRedistribution::begin(Move move)
{
    gpu::Pacer& pacer = solver_->pacer();
    pacer.finish();
    move_ = std::move(move);
    before_.clear();
    for (const Placement& placement : world_->placements())
        before_.push_back(placement.now);
    Patches3 patches = patches_to_shoot();
    pairs_.moved.upload(move_.moved);
    pairs_.boxes = gpu::Array<MovedBox>(*device_, view(move_.boxes));
    phases_.begin(rows_->list_of(std::move(patches.unknown)),
                  rows_->list_of(std::move(patches.moving)),
                  rows_->list_of(std::move(patches.all)));
    if (phases_.phase() == ShotPhases::Phase::after)
        go_after();
    return is_under_way();
}

IncrementalRedistribution::Patches3 IncrementalRedistribution::patches_to_shoot()
{
    const Patches& layout = solver_->shots().layout();
    const std::vector<std::uint32_t> levels = solver_->shots().levels().download();
    const std::vector<glm::vec3> shot = solver_->light().shot.download();
    const float slack = edge_slack(solver_->shots().views().layout());
    rows_->follow(levels);
    Patches3 found;
    for (std::uint32_t c = 0; c < levels.size(); ++c) {
        const std::uint32_t count =
            levels[c] == kNoLevel ? 0 : patches_of(layout.charts[c], levels[c]);
        const bool moves = move_.moved[lumels_->lumels[layout.charts[c].first_lumel].instance] != 0;
        for (std::uint32_t index = 0; index < count; ++index) {
            const ChosenPatch chosen{c, levels[c], index, kSendShot};
            const Patch patch = patch_of(layout, chosen);
            if (!may_see(move_, *lumels_, before_, patch, slack))
                continue;
            if (!has_shot(shot, patch)) {
                rows_->forget(chosen);
                continue;
            }
            found.all.push_back(chosen);
            if (!rows_->knows(chosen))
                found.unknown.push_back(chosen);
            if (moves && rows_->row_of(chosen) != kNoRow)
                found.moving.push_back(chosen);
        }
    }
    return found;
}

/// Moves the world; what moved has no light then.
void IncrementalRedistribution::go_after()
{
    gpu::Pacer& pacer = solver_->pacer();
    pacer.dispatch("redistribute", reset_,
                   {.lumels = world_->lumels(), .moved = pairs_.moved, .far = solver_->light().far},
                   CountParams{std::uint32_t(world_->lumels().size())}, world_->lumels().size());
    pacer.finish();
    world_->place(move_.transforms);
    phases_.end_if_empty();
}

void IncrementalRedistribution::look()
{
    solver_->shots().look(solver_->pacer());
    hemicubes_ += solver_->shots().batch();
}

bool IncrementalRedistribution::step()
{
    if (!is_under_way())
        return false;
    PatchShots& shots = solver_->shots();
    solver_->pacer().work("redistribute", [&](gpu::Commands& commands) {
        shots.take(commands, solver_->light(), phases_.list().chosen, phases_.next());
    });
    if (phases_.phase() == ShotPhases::Phase::before) {
        look();
        rows_->record(phases_.list(), phases_.next());
        receive(-1.0f);
    } else if (phases_.phase() == ShotPhases::Phase::back) {
        rows_->shoot(phases_.list(), phases_.next(), -1.0f);
    } else {
        look();
        receive(1.0f);
    }
    if (phases_.pass(shots.batch()))
        go_after();
    return is_under_way();
}

void IncrementalRedistribution::receive(float sign)
{
    const PatchShots& shots = solver_->shots();
    const auto first_place = phases_.list().patches.begin() + phases_.next();
    if (sign < 0.0f && std::none_of(first_place, first_place + shots.batch(), [&](auto& patch) {
            return patch.chart != kNoPatch && rows_->row_of(patch) == kNoRow;
        }))
        return;
    pairs_.receive("redistribute to lumels", *world_, *solver_, phases_.list(), phases_.next(),
                   sign, *rows_, true, solver_->light().far);
}

}  // namespace lumel
