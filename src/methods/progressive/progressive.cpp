// Progressive refinement radiosity.
//
//   [CCWG88] M. Cohen, S. Chen, J. Wallace, D. Greenberg. A Progressive Refinement Approach to
//            Fast Radiosity Image Generation. 1988.
//   [FP92]   M. Feda, W. Purgathofer. Accelerating Radiosity by Overshooting. 1992.
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Sections 2.2.4 and 4.3.
//
// Solves  B = E + ρ T B  by shooting unshot light, [Hoef13] Algorithm 4.2:
//
//     repeat
//         find the chart with the most unshot light             power, select
//         divide it into patches, with their light              take
//         see the world from each of them                       look_from
//         for all lumels i:                                     receive
//             H_i += Σ_k B_k^u A_k V cosθ cosθ / (π r²)         Eq. (2.2.8)
//         B_k^s += B_k^u                                        settle
//
// Stores B^s, the light shot, and H = T B^s. All else follows: B = E + ρH, and B^u = B - B^s. After
// a change of emission or reflectance, Eqs. (2.2.9) and (2.2.10), only E or ρ is replaced.
//
// T never changes: patches shoot from fixed points with fixed hemicubes to fixed points. Shot light
// can be taken back exactly.
//
// Differs from the thesis:
// - Patches shoot in batches, across charts; the GPU chooses them without readback.
// - Depth and the receiver's plane decide visibility, where the thesis draws ids and reads the
//   four nearest pixels: one chart can occlude itself, and surfaces need not be quads.
// - Patches also send at once their reflection of light still to be shot [FP92]. If that was too
//   much, their unshot light becomes negative and is shot in turn.
// - Pairs of close lumels are left out and solved exactly (the near field).

#include "methods/progressive/progressive.h"

#include <algorithm>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Weight of missing light, a bias of all lumels, relative to noise.
constexpr double kMissing = 4.0;
/// When lamps go out, the residual is relative to at least this fraction of the maximum light so
/// far; relative to nothing it would stay large.
constexpr double kDark = 0.01;
/// A scene without any light received after this number of batches is unlit.
constexpr std::uint64_t kSilent = 16;
/// Batches between near-field sums, each of which costs about one batch's receiving.
constexpr std::uint64_t kNearEvery = 4;

/// The finest level at which all points of a lumel fit a batch.
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

/// Unshot light and its future bounces, relative to all light in the end.
double missing_part(const Terms& terms, double least = 0.0)
{
    const double unshot = terms.column[0].x, arrived = terms.column[0].y,
                 reflected = terms.column[0].z;
    constexpr double kMinLost = 1e-3;  // fraction lost per bounce: 1 / it stays finite
    const double onward = arrived > 0.0 ? reflected / arrived : 0.0;
    const double remaining = unshot / std::max(1.0 - onward, kMinLost);
    return remaining > 0.0 ? remaining / (std::max(arrived, least) + remaining) : 0.0;
}

}  // namespace

ProgressiveRadiosity::ProgressiveRadiosity(const gpu::Device& device, const World& world,
                                           const Lumels& lumels, const NearField& near,
                                           const ProgressiveOptions& options)
    : world_(&world),
      count_(std::uint32_t(lumels.lumels.size())),
      near_radius_(near.radius),
      patch_share_(1.0f / float(options.shooters)),
      emitted_power_(emitted_power(lumels, emission_of(lumels))),
      area_(std::max(area_of(lumels), 1e-30f)),
      power_(device),
      select_(device),
      receive_(device, std::uint32_t(options.views.projection)),
      settle_(device),
      residual_(device),
      light_(device, lumels),
      shots_(device, world, lumels, options.views, options.seed),
      chart_light_(device, shots_.layout().charts.size()),
      ambient_(device, 1),
      cursor_(device, 1),
      near_rows_(device, near, count_),
      figures_(device, count_),
      pacer_(device)
{
    pacer_.work("prepare", [&](gpu::Commands& commands) {
        for (const auto* array : {&light_.shot, &light_.far, &light_.near})
            commands.fill(array->buffer());
        commands.fill(shots_.levels().buffer(), kNoLevel);
        commands.fill(cursor_.buffer());
        commands.fill(ambient_.buffer());
    });
}

std::uint64_t ProgressiveRadiosity::device_bytes(const SolveSize& size,
                                                 const ProgressiveOptions& options)
{
    const std::size_t count = size.count();
    const std::size_t charts = make_patches(*size.lumels).charts.size();
    return ShotLight::device_bytes(count) + PatchShots::device_bytes(size, options.views) +
           charts * sizeof(ChartLight) + sizeof(Cursor) + sizeof(glm::vec3) +
           NearRows::device_bytes(count, size.near_pairs) + LumelSums::device_bytes(count);
}

void ProgressiveRadiosity::step()
{
    take_figures();
    choose();
    shots_.look(pacer_);
    receive();
    settle();
    if (state_.iterations % kNearEvery == kNearEvery - 1)
        pacer_.work("near", [&](gpu::Commands& commands) { light_near(commands); });
    ++state_.iterations;
    state_.shots += shots_.batch();
    ask_figures();
}

void ProgressiveRadiosity::choose()
{
    const auto charts = std::uint32_t(shots_.layout().charts.size());
    const ChooseParams params{.charts = charts,
                              .batch = shots_.batch(),
                              .finest = finest_level(shots_.batch()),
                              .patch_share = patch_share_,
                              .area = area_};
    pacer_.work("select", [&](gpu::Commands& commands) {
        commands.dispatch(power_,
                          {.surface = light_.surface,
                           .emission = light_.emission,
                           .far = light_.far,
                           .near = light_.near,
                           .shot = light_.shot,
                           .ambient = ambient_,
                           .charts = shots_.charts(),
                           .lights = chart_light_},
                          params, std::size_t(charts) * kPatchGroup);
        commands.dispatch(select_,
                          {.charts = shots_.charts(),
                           .lights = chart_light_,
                           .levels = shots_.levels(),
                           .kept_cursor = cursor_,
                           .chosen = shots_.chosen(),
                           .ambient = ambient_},
                          params, 1);
        shots_.take(commands, light_, ambient_);
    });
}

void ProgressiveRadiosity::receive()
{
    const EyeViews& views = shots_.views();
    pacer_.dispatch_parts(
        "receive", count_, kProbeLumels, receive_,
        {.lumels = world_->lumels(),
         .pieces = world_->pieces(),
         .views = {views.image(), views.sampler()},
         .eyes = shots_.eyes(),
         .shots = shots_.shots(),
         .sending = shots_.sending(),
         .far = light_.far},
        {.views = views.layout(), .shots = shots_.batch(), .near_radius = near_radius_});
}

void ProgressiveRadiosity::settle()
{
    pacer_.dispatch("settle", settle_,
                    {.chosen = shots_.chosen(),
                     .shots = shots_.shots(),
                     .sending = shots_.sending(),
                     .shot = light_.shot},
                    TakeParams{shots_.batch()}, shots_.batch());
}

void ProgressiveRadiosity::light_near(gpu::Commands& commands)
{
    if (near_radius_ > 0.0f)
        near_rows_.light(commands, light_.shot, light_.near);
}

void ProgressiveRadiosity::set_near_field(const NearField& near)
{
    pacer_.finish();
    near_rows_.replace(near);
    pacer_.work("near", [&](gpu::Commands& commands) { light_near(commands); });
}

void ProgressiveRadiosity::sum_figures(gpu::Commands& commands)
{
    light_near(commands);
    commands.dispatch(residual_,
                      {.surface = light_.surface,
                       .emission = light_.emission,
                       .far = light_.far,
                       .near = light_.near,
                       .shot = light_.shot,
                       .lumels = world_->lumels(),
                       .parts = figures_.parts()},
                      CountParams{count_}, count_);
    figures_.add_up(commands);
}

void ProgressiveRadiosity::ask_figures()
{
    figures_.request(pacer_, state_.iterations,
                     [&](gpu::Commands& commands) { sum_figures(commands); });
}

void ProgressiveRadiosity::take_figures()
{
    const std::optional<Terms> terms = figures_.poll(pacer_, state_.iterations);
    if (!terms)
        return;
    if (terms->column[0].y > 0.0f)
        state_.error = kMissing * missing_part(*terms);
    else
        state_.error = emitted_power_ > 0.0 && state_.iterations < kSilent ? -1.0 : 0.0;
}

double ProgressiveRadiosity::residual()
{
    const Terms terms =
        figures_.read_now(pacer_, [&](gpu::Commands& commands) { sum_figures(commands); });
    most_arrived_ = std::max(most_arrived_, double(terms.column[0].y));
    return missing_part(terms, kDark * most_arrived_);
}

std::vector<glm::vec3> ProgressiveRadiosity::irradiance()
{
    pacer_.work("near", [&](gpu::Commands& commands) { light_near(commands); });
    pacer_.finish();
    std::vector<glm::vec3> sum = light_.far.download();
    const std::vector<glm::vec3> near = light_.near.download();
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += near[i];
    return sum;
}

}  // namespace lumel
