// Progressive refinement radiosity.
//
//   [CCWG88] M. Cohen, S. Chen, J. Wallace, D. Greenberg. A Progressive Refinement Approach to
//            Fast Radiosity Image Generation. 1988.
//   [FP92]   M. Feda, W. Purgathofer. Accelerating Radiosity by Overshooting. 1992.
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 2.2.4 and 4.3.
//
// Solves  B = E + ρ T B  by shooting what was not shot yet, [Hoef13] Algorithm 4.2:
//
//     repeat
//         find the chart with the most unshot light             power, select
//         divide it into patches; what each sends               take
//         see the world from each of them                       look_from
//         for all lumels i:                                     receive
//             H_i += Σ_k B_k^u A_k V cosθ cosθ / (π r²)         Eq. (2.2.8)
//         B_k^s += B_k^u                                        settle
//
// What is kept is B^s, the light shot, and H = T B^s. All else follows: B = E + ρH, and
// B^u = B - B^s. Changed emission or reflectance, Eqs. (2.2.9) and (2.2.10), needs no more than
// the new E or ρ.
//
// T is the same whenever it is asked for: patches shoot from fixed points with fixed hemicubes to
// fixed points. What was shot can be taken back exactly.
//
// Differs from the thesis:
// - Patches shoot in batches, across charts; the GPU chooses them, and nothing is read back.
// - Depth and the receiver's plane tell what is seen, where the thesis draws ids and asks the four
//   nearest pixels: one chart may then hide itself, and surfaces need not be quads.
// - Patches send at once what they will reflect of light that is still under way [FP92]. If that
//   was too much, their unshot light becomes negative and is shot in turn.
// - Pairs of close lumels are left out and solved exactly (the near field).

#include "solve/progressive.h"

#include <algorithm>
#include <cmath>

#include "solve/lumel_arrays.h"

namespace lumel {
namespace {

constexpr std::uint32_t kPowerSpirv[] = {
#include "solve/progressive.power.comp.inc"
};
constexpr std::uint32_t kSelectSpirv[] = {
#include "solve/progressive.select.comp.inc"
};
constexpr std::uint32_t kTakeSpirv[] = {
#include "solve/progressive.take.comp.inc"
};
constexpr std::uint32_t kReceiveSpirv[] = {
#include "solve/progressive.receive.comp.inc"
};
constexpr std::uint32_t kSettleSpirv[] = {
#include "solve/progressive.settle.comp.inc"
};
constexpr std::uint32_t kResidualSpirv[] = {
#include "solve/progressive.residual.comp.inc"
};

constexpr gpu::Slot kReceiveSlots[] = {gpu::Slot::array, gpu::Slot::array,   gpu::Slot::array,
                                       gpu::Slot::array, gpu::Slot::texture, gpu::Slot::array,
                                       gpu::Slot::array};

/// A patch sends at most this part of all light: shadows of so many points look soft.
constexpr float kPatchShare = 1.0f / 512.0f;
/// Light that is missing is missing everywhere, which counts so many times as much as noise.
constexpr double kMissing = 4.0;
/// A scene in which nothing arrives after so many batches catches no light.
constexpr std::uint64_t kSilent = 16;
/// Batches between two sums of the near field, which costs about as much as one batch's receiving.
constexpr std::uint64_t kNearEvery = 4;

/// The finest level whose points of one lumel fit a batch.
std::uint32_t finest_level(std::uint32_t batch)
{
    std::uint32_t level = kLumelLevel;
    while (level + 1 < kPatchLevels && (4u << (2 * (level - kLumelLevel))) <= batch)
        ++level;
    return level;
}

float area_of(const Lumels& lumels)
{
    double sum = 0.0;
    for (const glm::vec4& surface : surfaces_of(lumels))
        sum += double(surface.a);
    return float(sum);
}

}  // namespace

ProgressiveRadiosity::ProgressiveRadiosity(const gpu::Device& device, const World& world,
                                           const Lumels& lumels, const NearField& near,
                                           const SolverOptions& options)
    : count_(std::uint32_t(lumels.lumels.size())),
      near_radius_(near.radius),
      emitted_power_(emitted_power(lumels, emission_of(lumels))),
      area_(std::max(area_of(lumels), 1e-30f)),
      world_(&world),
      power_(device, "progressive.power", kPowerSpirv, 7, sizeof(ChooseParams), kProgressiveGroup),
      select_(device, "progressive.select", kSelectSpirv, 6, sizeof(ChooseParams),
              kProgressiveGroup),
      take_(device, "progressive.take", kTakeSpirv, 14, sizeof(TakeParams), kProgressiveGroup),
      receive_(device, "progressive.receive", kReceiveSpirv, kReceiveSlots,
               sizeof(PatchReceiveParams), kProgressiveGroup, std::uint32_t(options.projection)),
      settle_(device, "progressive.settle", kSettleSpirv, 4, sizeof(TakeParams), kProgressiveGroup),
      residual_(device, "progressive.residual", kResidualSpirv, 6, sizeof(ResidualParams),
                kSumGroup),
      views_(device, world, options.projection, std::uint32_t(options.hemicube),
             checked_batch(method_of("progressive"), options.batch)),
      batch_(views_.capacity()),
      layout_(make_patches(lumels)),
      patches_(device, view(layout_.patches)),
      charts_(device, view(layout_.charts)),
      chart_light_(device, layout_.charts.size()),
      ambient_(device, 1),
      levels_(device, layout_.charts.size()),
      cursor_(device, 1),
      chosen_(device, batch_),
      eyes_(device, batch_),
      shots_(device, batch_),
      surface_(device, view(surfaces_of(lumels))),
      emission_(device, view(emission_of(lumels))),
      shot_(device, count_),
      sending_(device, count_),
      far_(device, count_),
      near_(device, count_),

      near_rows_(device, near, count_),
      figures_(device, count_),
      pacer_(device)
{
    pacer_.work("prepare", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        for (const auto* array : {&shot_, &sending_, &far_, &near_})
            commands.fill(array->buffer());
        commands.fill(levels_.buffer(), kNoLevel);
        commands.fill(cursor_.buffer());
        commands.fill(ambient_.buffer());
    });
}

void ProgressiveRadiosity::step()
{
    take_figures();
    choose();
    views_.look_from(pacer_, eyes_, batch_);
    receive();
    settle();
    ++state_.iterations;
    state_.shots += batch_;
    ask_figures();
}

void ProgressiveRadiosity::choose()
{
    const ChooseParams params{.charts = std::uint32_t(layout_.charts.size()),
                              .batch = batch_,
                              .finest = finest_level(batch_),
                              .patch_share = kPatchShare,
                              .area = area_};
    pacer_.work("select", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        commands.dispatch(power_, {charts_, surface_, emission_, far_, near_, shot_, chart_light_},
                          params, std::size_t(params.charts) * kProgressiveGroup);
        commands.dispatch(select_, {charts_, chart_light_, levels_, cursor_, chosen_, ambient_},
                          params, 1);
        take(commands);
    });
}

void ProgressiveRadiosity::take(gpu::Commands& commands)
{
    commands.dispatch(take_,
                      {world_->lumels(), world_->pieces(), charts_, patches_, chosen_, surface_,
                       emission_, far_, near_, shot_, sending_, eyes_, shots_, ambient_},
                      TakeParams{batch_}, batch_);
}

void ProgressiveRadiosity::receive()
{
    pacer_.work("receive", count_, kProbeLumels,
                [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                    commands.dispatch(receive_,
                                      {world_->lumels(),
                                       world_->pieces(),
                                       eyes_,
                                       shots_,
                                       {views_.image(), views_.sampler()},
                                       sending_,
                                       far_},
                                      PatchReceiveParams{.views = views_.layout(),
                                                         .first = first,
                                                         .last = last,
                                                         .shots = batch_,
                                                         .near_radius = near_radius_},
                                      last - first);
                });
}

void ProgressiveRadiosity::settle()
{
    pacer_.work("settle", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        commands.dispatch(settle_, {chosen_, shots_, sending_, shot_}, TakeParams{batch_}, batch_);
        if (state_.iterations % kNearEvery == kNearEvery - 1)
            light_near(commands);
    });
}

void ProgressiveRadiosity::light_near(gpu::Commands& commands)
{
    if (near_radius_ > 0.0f)
        near_rows_.light(commands, shot_, near_);
}

void ProgressiveRadiosity::ask_figures()
{
    figures_.ask(pacer_, state_.iterations, [&](gpu::Commands& commands) {
        light_near(commands);
        commands.dispatch(residual_, {surface_, emission_, far_, near_, shot_, figures_.parts()},
                          ResidualParams{count_}, count_);
        figures_.add_up(commands);
    });
}

void ProgressiveRadiosity::take_figures()
{
    const std::optional<Terms> terms = figures_.take(pacer_, state_.iterations);
    if (!terms)
        return;
    const glm::vec4 sums = terms->column[0];
    const double unshot = sums.x, arrived = sums.y, reflected = sums.z;
    if (!(arrived > 0.0)) {
        state_.error = emitted_power_ > 0.0 && state_.iterations < kSilent ? -1.0 : 0.0;
        return;
    }
    // Of each lumen that arrives, so much is sent on and arrives again.
    const double onward = std::min(reflected / arrived, 1.0);
    const double remaining = unshot / std::max(1.0 - onward, 1e-3);
    state_.error = kMissing * remaining / (arrived + remaining);
}

std::vector<glm::vec3> ProgressiveRadiosity::irradiance()
{
    pacer_.work("near", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        light_near(commands);
    });
    pacer_.finish();
    std::vector<glm::vec3> sum = far_.download();
    const std::vector<glm::vec3> near = near_.download();
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += near[i];
    return sum;
}

}  // namespace lumel
