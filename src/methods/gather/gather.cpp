// Gather radiosity.
//
//   [CG85]   Cohen, Greenberg. The Hemi-Cube: A Radiosity Solution for Complex Environments. 1985.
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            2013. 2.2.2, 4.2 and Algorithm 4.1.
//
//     B ← E
//     repeat                                                     a bounce
//         for all lumels i, K at a time:
//             render B on a hemicube at i                        lit_views.h
//             H_i ← Σ_q ΔF_q B_q over its pixels q               integrate
//             B_i ← E_i + ρ_i H_i                                bounce, Eq. (2.2.2)
//
// B is one array: lumels see light that others sent in the same bounce, the Gauss-Seidel
// iteration of [CG85]. Shares no form factor, visibility test or near field with the shooting
// solvers. Cost of a bounce: N hemicubes.
//
// Differs from the papers:
// - No fixed number of bounces: they continue until the residual is small. A change |ΔH| sends
//   ρ|ΔH| on, which bounds the light still to arrive.
// - A hemicube sees from a point, while a lumel's value is its mean over the area. Once light has
//   converged at lumel centres, points move from bounce to bounce and H_i is the mean over them;
//   the difference of two half-solutions of independent points gives its error. With
//   SampleRule::centre or Scheme::paper points stay, and the estimated error is only the residual.
// - Delta form factors are exact for the part of a pixel that each sample represents. Samples are
//   not resolved to pixels first.
// - Pixels behind the geometric surface are black, where the shading normal differs from it.
// - With coloured glass each lumel has a hemicube per colour channel.

#include "methods/gather/gather.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "base/core/error.h"
#include "methods/gather/hemicube_light.h"
#include "raster/eyes/eye_views.h"
#include "raster/eyes/hemicube_tiles.h"
#include "raster/eyes/view_options.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Offset of eyes from the surface, relative to the largest coordinate: ten times the rounding
/// error that may place them below it.
constexpr float kLift = 2e-6f;
/// Near plane, relative to the ray offset: excludes no geometry in front of an eye.
constexpr float kNearPart = 1e-3f;
/// Maximum pixels of all hemicubes of a batch: 320 MiB.
constexpr std::uint64_t kMaxEyePixels = 4u << 20;
/// Light has converged once its relative residual is below this, or below this part of the target
/// error.
constexpr double kSettled = 1e-3, kSettledPart = 0.25;

float lift_of(const World& world)
{
    const glm::vec3 most = glm::max(glm::abs(world.low()), glm::abs(world.high()));
    return kLift * std::max({world.diagonal(), most.x, most.y, most.z, 1e-20f});
}

/// Side of level 0 of a hemicube's mipmaps [pixels]: the tile in a square of a power of two.
std::uint32_t mipmap_side(std::uint32_t hemicube)
{
    return std::bit_ceil(hemicube_tiles(hemicube, 1).width);
}

/// Maximum pixels of level 0 of all mipmaps of a batch: a dispatch of 32,768 groups.
constexpr std::uint64_t kMaxMipmapPixels = 2u << 20;
/// Maximum side of a hemicube that has mipmaps: those of one lumel fit a dispatch in all channels.
constexpr int kMaxMipmapHemicube = 512;

std::uint32_t wanted_hemicubes(const GatherOptions& options, std::uint32_t channels)
{
    const Tiles tile = hemicube_tiles(std::uint32_t(options.hemicube), 1);
    const std::uint64_t pixels =
        std::max<std::uint64_t>(std::uint64_t(tile.width) * tile.height, 1);
    std::uint64_t fit = kMaxEyePixels / pixels;
    if (options.integration == Integration::mipmap) {
        if (options.hemicube > kMaxMipmapHemicube)
            throw Error(
                ErrorKind::input, "--integration",
                fmt::format("mipmap takes hemicubes of side {} at most", kMaxMipmapHemicube));
        const std::uint64_t side = mipmap_side(std::uint32_t(options.hemicube));
        fit = std::min(fit, kMaxMipmapPixels / (side * side));
    }
    fit = std::max<std::uint64_t>(fit, channels);
    const auto asked = std::uint32_t(options.batch);
    return std::uint32_t(std::min<std::uint64_t>(fit, std::max(asked, channels)));
}

std::vector<std::uint32_t> open_lumels(const Lumels& lumels)
{
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i)
        if (!(lumels.lumels[i].flags & kLumelBuried))
            open.push_back(std::uint32_t(i));
    return open;
}

/// Pixels of all levels of a hemicube's mipmaps.
std::size_t mipmap_pixels(const GatherOptions& options)
{
    std::size_t pixels = 0;
    if (options.integration == Integration::mipmap)
        for (std::size_t side = mipmap_side(std::uint32_t(options.hemicube)); side > 0; side /= 2)
            pixels += side * side;
    return pixels;
}

}  // namespace

GatherRadiosity::GatherRadiosity(const gpu::Device& device, const World& world,
                                 const Lumels& lumels, const GatherOptions& options,
                                 double target_error)
    : options_(options),
      target_error_(target_error),
      count_(std::uint32_t(lumels.lumels.size())),
      world_(&world),
      channels_(world.has_coloured_glass() ? kChannels : 1),
      ray_offset_(lift_of(world)),
      eyes_kernel_(device),
      integrate_(device),
      multiply_(device),
      reduce_(device),
      bounce_(device),
      figures_kernel_(device),
      views_(device, world, std::uint32_t(options.hemicube), kNearPart * ray_offset_,
             wanted_hemicubes(options, channels_)),
      batch_(std::max(views_.capacity() / channels_, 1u)),
      order_(device, view(open_lumels(lumels))),
      lumel_of_(device, view(nearest_lumels_by_side(lumels))),
      width_(std::uint32_t(lumels.width)),
      height_(std::uint32_t(lumels.height)),
      delta_form_factors_(device, view(delta_form_factors(std::uint32_t(options.hemicube),
                                                          device.has_standard_samples()))),
      eyes_(device, views_.capacity()),
      points_(device, views_.capacity()),
      gathered_(device, views_.capacity()),
      mipmaps_(device, mipmap_pixels(options) * views_.capacity()),
      surface_(device, view(surfaces_of(lumels))),
      emission_(device, view(emission_of(lumels))),
      radiosity_(device, view(emission_of(lumels))),
      irradiance_(device, count_),
      change_(device, count_),
      sums_(device, std::size_t(2) * count_),
      figures_(device, count_),
      pacer_(device)
{
    pacer_.work("prepare", [&](gpu::Commands& commands) {
        for (const auto* array : {&irradiance_, &change_, &sums_})
            commands.fill(array->buffer());
    });
}

std::uint64_t GatherRadiosity::device_bytes(const SolveSize& size, const GatherOptions& options)
{
    constexpr std::uint64_t kVectors = 4, kHalves = 1;  // arrays of vec3 [N] and [2][N]
    const auto side = std::uint32_t(options.hemicube);
    const std::uint32_t views = wanted_hemicubes(options, 1);
    return LitViews::device_bytes(side, views) +
           view_pixels(Projection::hemicube, side) * gpu::kManySamples * sizeof(float) +
           views * (sizeof(Eye) + sizeof(GatheringPoint) + sizeof(glm::vec3)) +
           size.count() * (sizeof(std::uint32_t) + sizeof(glm::vec4) +
                           (kVectors + 2 * kHalves) * sizeof(glm::vec3)) +
           views * mipmap_pixels(options) * sizeof(glm::vec3) +
           2 * size.texels() * sizeof(std::uint32_t) + LumelSums::device_bytes(size.count());
}

void GatherRadiosity::step()
{
    const auto open = std::uint32_t(order_.size());
    const std::uint32_t lumels = std::min(batch_, open - next_);
    if (lumels > 0) {
        place_eyes(lumels);
        views_.look_from(pacer_, eyes_, {&lumel_of_, &radiosity_, width_, height_},
                         lumels * channels_);
        integrate(lumels * channels_);
        bounce(lumels);
    }
    next_ += lumels;
    ++state_.iterations;
    state_.shots += std::uint64_t(lumels) * channels_;
    if (next_ == open)
        end_bounce();
}

void GatherRadiosity::place_eyes(std::uint32_t lumels)
{
    const GatherEyesParams params{.first = next_,
                                  .eyes = lumels * channels_,
                                  .channels = channels_,
                                  .point = taken_[half()],
                                  .seed = 2 * options_.seed + half(),
                                  .centre = averages_ ? 0u : 1u,
                                  .ray_offset = ray_offset_};
    pacer_.dispatch("eyes", eyes_kernel_,
                    {.lumels = world_->lumels(),
                     .pieces = world_->pieces(),
                     .order = order_,
                     .eyes = eyes_,
                     .points = points_},
                    params, params.eyes);
}

void GatherRadiosity::integrate_by_mipmaps(std::uint32_t eyes)
{
    std::uint32_t side = mipmap_side(std::uint32_t(options_.hemicube)), from = 0;
    const auto whole = float(side) * float(side);
    pacer_.work("integrate", [&](gpu::Commands& commands) {
        commands.dispatch(
            multiply_,
            {.views = {views_.image(), views_.sampler()},
             .points = points_,
             .delta_form_factor = delta_form_factors_,
             .mipmaps = mipmaps_},
            {.views = views_.layout(), .samples = gpu::kManySamples, .side = side, .eyes = eyes},
            std::size_t(eyes) * side * side);
        while (side > 1) {
            const std::uint32_t to = from + eyes * side * side;
            side /= 2;
            commands.dispatch(reduce_, {.mipmaps = mipmaps_, .gathered = gathered_},
                              {.side = side, .from = from, .to = to, .eyes = eyes, .whole = whole},
                              std::size_t(eyes) * side * side);
            from = to;
        }
    });
}

void GatherRadiosity::integrate(std::uint32_t eyes)
{
    if (options_.integration == Integration::mipmap)
        return integrate_by_mipmaps(eyes);
    const IntegrateParams params{.views = views_.layout(), .samples = gpu::kManySamples};
    pacer_.dispatch("integrate", integrate_,
                    {.views = {views_.image(), views_.sampler()},
                     .points = points_,
                     .delta_form_factor = delta_form_factors_,
                     .gathered = gathered_},
                    params, std::size_t(eyes) * kIntegrateGroup);
}

void GatherRadiosity::bounce(std::uint32_t lumels)
{
    std::array<std::uint32_t, 2> taken = taken_;
    ++taken[half()];
    const BounceParams params{.first = next_,
                              .lumels = lumels,
                              .channels = channels_,
                              .count = count_,
                              .averaged = averages_ ? 1u : 0u,
                              .half_index = half(),
                              .taken = {taken[0], taken[1]}};
    pacer_.dispatch("bounce", bounce_,
                    {.order = order_,
                     .gathered = gathered_,
                     .surface = surface_,
                     .emission = emission_,
                     .sums = sums_,
                     .change = change_,
                     .irradiance = irradiance_,
                     .radiosity = radiosity_},
                    params, lumels);
}

/// Reads the statistics of the bounce at once: this takes far less time than a bounce.
void GatherRadiosity::end_bounce()
{
    next_ = 0;
    if (averages_)
        ++taken_[half()];
    const Terms terms = figures_.read_now(pacer_, [&](gpu::Commands& commands) {
        commands.dispatch(figures_kernel_,
                          {.surface = surface_,
                           .sums = sums_,
                           .change = change_,
                           .irradiance = irradiance_,
                           .parts = figures_.parts()},
                          BounceFiguresParams{count_, {taken_[0], taken_[1]}}, count_);
        figures_.add_up(commands);
    });
    const bool points_stay = options_.rule == SampleRule::centre;
    if (!averages_) {
        remaining_ = still_to_come(terms);
        const double settled =
            target_error_ > 0.0 ? std::max(kSettledPart * target_error_, kSettled) : kSettled;
        if (points_stay)
            state_.error = remaining_;
        else
            averages_ = remaining_ <= settled;
    } else if (taken_[1] > 0) {
        const glm::vec4 sums = terms.column[1];
        const double light = std::max(double(sums.y), 1e-30);
        const double apart = std::sqrt(3.0 * double(sums.x) * double(sums.z)) / light;
        // Few lumels dominate, so halves can agree by chance: takes the larger of two bounces.
        state_.error = std::hypot(std::max(apart, apart_), remaining_);
        apart_ = apart;
    }
}

/// Residual relative to the light that has arrived.
double GatherRadiosity::still_to_come(const Terms& terms) const
{
    const glm::vec4 sums = terms.column[0];
    const double moved = sums.x, sent_on = sums.y, arrived = sums.z;
    if (!(moved > 0.0))
        return 0.0;
    constexpr double kMin = 1e-3;  // assumed minimum loss per bounce
    return sent_on / std::max(1.0 - sent_on / moved, kMin) / arrived;
}

std::vector<glm::vec3> GatherRadiosity::irradiance()
{
    pacer_.finish();
    return irradiance_.download();
}

}  // namespace lumel
