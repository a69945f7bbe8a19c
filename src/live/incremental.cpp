// Incremental radiosity.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 3.1, 3.2 and 4.4.
//
// What is kept is H = T B^s (progressive.cpp). After a move T is T', and
//
//     H' = H - T B^s + T' B^s                                              Eq. (3.2.1)
//
// restricted to the pairs that differ: those that moved, and those that what moved came between or
// left. [Hoef13] section 3.1 names them by who shoots and who receives, C still and M moved:
//
//     R(M, C)   the light of M is taken back from where it was, and sent from where it is
//     R(C, M)   M forgets what arrived, and all is shot to it anew (reshooting, Eq. (4.4.1))
//     R(M, M)   the same
//     R(C, C)   taken back with the views of before, sent with those of after: the four cases of
//               section 4.4.1 with the visibility of each
//
// Two hemicubes for each patch that has shot and sees what moved. T never changes, so errors
// do not accumulate over many moves.
//
// Differs from the thesis:
// - Light not shot yet is not sent along: the progressive solver goes on with it afterwards.
// - Pairs whose line of sight stays clear of what moved are not looked up.

#include "live/incremental.h"

#include <algorithm>

#include "shooting/lumel_arrays.h"

namespace lumel {
namespace {

constexpr std::uint32_t kReceiveSpirv[] = {
#include "live/incremental.receive.comp.inc"
};
constexpr std::uint32_t kResetSpirv[] = {
#include "live/incremental.reset.comp.inc"
};

constexpr gpu::Slot kReceiveSlots[] = {gpu::Slot::array, gpu::Slot::array,   gpu::Slot::array,
                                       gpu::Slot::array, gpu::Slot::texture, gpu::Slot::array,
                                       gpu::Slot::array, gpu::Slot::array,   gpu::Slot::array};

/// Pixels by which an edge may seem to stand out: the test of visibility reads pixels around a
/// point.
constexpr float kEdgePixels = 3.0f;

/// The angle [rad] of that many pixels, on a hemicube's face where they are widest.
float edge_slack(const EyeViewLayout& views)
{
    return kEdgePixels * 2.0f / float(views.side);
}

/// Do all corners of the box lie behind the plane through x?
bool is_behind(const MovedBox& box, const glm::vec3& x, const glm::vec3& normal, float slack)
{
    const glm::vec3 highest = glm::mix(box.low, box.high, glm::greaterThan(normal, glm::vec3(0)));
    const glm::vec3 reach = glm::max(glm::abs(box.low - x), glm::abs(box.high - x));
    return glm::dot(highest - x, normal) < -slack * glm::length(reach);
}

/// The lumels of a patch, as patch_shots.take.comp has them.
Patch patch_of(const Patches& layout, const ChosenPatch& chosen)
{
    const PatchChart& chart = layout.charts[chosen.chart];
    if (chosen.level < kBlockLevels)
        return layout.patches[chart.first_patch[chosen.level] + chosen.index];
    const std::uint32_t lumel = chart.first_lumel + chosen.index / points_per_lumel(chosen.level);
    return {lumel, 1, lumel, 0.0f};
}

}  // namespace

IncrementalRedistribution::IncrementalRedistribution(const gpu::Device& device, World& world,
                                                     const Lumels& lumels,
                                                     ProgressiveRadiosity& solver,
                                                     Projection projection)
    : device_(&device),
      world_(&world),
      lumels_(&lumels),
      solver_(&solver),
      receive_(device, "incremental.receive", kReceiveSpirv, kReceiveSlots,
               sizeof(RedistributeParams), kPatchGroup, std::uint32_t(projection)),
      reset_(device, "incremental.reset", kResetSpirv, 3, sizeof(ResetParams), kPatchGroup),
      moved_(device, world.placements().size()),
      boxes_(device, 1),
      list_(device, 1)
{
}

void IncrementalRedistribution::begin(Move move)
{
    gpu::Pacer& pacer = solver_->pacer();
    pacer.finish();
    move_ = std::move(move);
    before_.clear();
    for (const Placement& placement : world_->placements())
        before_.push_back(placement.now);
    const std::vector<ChosenPatch> list = patches_to_shoot();
    moved_.upload(move_.moved);
    boxes_ = gpu::Array<MovedBox>(*device_, view(move_.boxes));
    list_ = gpu::Array<ChosenPatch>(*device_, view(list));
    next_ = 0;
    sign_ = -1.0f;
}

std::vector<ChosenPatch> IncrementalRedistribution::patches_to_shoot() const
{
    const Patches& layout = solver_->shots().layout();
    const std::vector<std::uint32_t> levels = solver_->shots().levels().download();
    const std::vector<glm::vec3> shot = solver_->light().shot.download();
    const float slack = edge_slack(solver_->shots().views().layout());
    const auto matters = [&](const ChosenPatch& chosen) {
        const Patch patch = patch_of(layout, chosen);
        const auto first = shot.begin() + patch.first;
        if (std::all_of(first, first + patch.count, [](auto& b) { return b == glm::vec3(0.0f); }))
            return false;
        const Lumel& lumel = lumels_->lumels[patch.first];
        if (move_.moved[lumel.instance] || (patch.count > 1 && patch.eye != kFromMean))
            return true;
        const glm::mat4& place = before_[lumel.instance];
        const glm::vec3 x(place * glm::vec4(lumel.position, 1.0f));
        const glm::vec3 normal =
            glm::normalize(glm::inverse(glm::transpose(glm::mat3(place))) * lumel.normal);
        return !std::all_of(move_.boxes.begin(), move_.boxes.end(),
                            [&](const MovedBox& box) { return is_behind(box, x, normal, slack); });
    };

    std::vector<ChosenPatch> list;
    for (std::uint32_t c = 0; c < levels.size(); ++c) {
        const std::uint32_t count =
            levels[c] == kNoLevel ? 0 : patches_of(layout.charts[c], levels[c]);
        for (std::uint32_t index = 0; index < count; ++index) {
            const ChosenPatch chosen{c, levels[c], index, kSendShot};
            if (matters(chosen))
                list.push_back(chosen);
        }
    }
    return in_whole_batches(std::move(list), solver_->shots().batch());
}

bool IncrementalRedistribution::step()
{
    if (!is_under_way())
        return false;
    gpu::Pacer& pacer = solver_->pacer();
    PatchShots& shots = solver_->shots();
    pacer.work("redistribute", [&](gpu::Commands& commands) {
        if (sign_ > 0.0f && next_ == 0)
            commands.dispatch(reset_, {world_->lumels(), moved_, solver_->light().far},
                              ResetParams{std::uint32_t(world_->lumels().size())},
                              world_->lumels().size());
        shots.take(commands, solver_->light(), list_, next_);
    });
    shots.look(pacer);
    receive();
    next_ += shots.batch();
    hemicubes_ += shots.batch();
    if (next_ < list_.size())
        return true;
    next_ = 0;
    if (sign_ < 0.0f) {
        pacer.finish();
        world_->place(move_.transforms);
        sign_ = 1.0f;
        return true;
    }
    sign_ = 0.0f;
    return false;
}

void IncrementalRedistribution::receive()
{
    gpu::Pacer& pacer = solver_->pacer();
    const PatchShots& shots = solver_->shots();
    const EyeViews& views = shots.views();
    pacer.work("redistribute to lumels", std::uint32_t(world_->lumels().size()), kProbeLumels,
               [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                   const RedistributeParams params{.views = views.layout(),
                                                   .first = first,
                                                   .last = last,
                                                   .shots = shots.batch(),
                                                   .near_radius = solver_->near_radius(),
                                                   .boxes = std::uint32_t(boxes_.size()),
                                                   .slack = edge_slack(views.layout()),
                                                   .sign_ = sign_};
                   commands.dispatch(receive_,
                                     {world_->lumels(),
                                      world_->pieces(),
                                      shots.eyes(),
                                      shots.shots(),
                                      {views.image(), views.sampler()},
                                      shots.sending(),
                                      solver_->light().far,
                                      moved_,
                                      boxes_},
                                     params, last - first);
               });
}

}  // namespace lumel
