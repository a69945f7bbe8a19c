// Radiosity by global directions with stochastic depth buffering.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.
//
//     repeat
//         for K directions d over the sphere:
//             draw the scene along d, every surface with a random depth      look_along, Figure 4
//             (in slabs along d, and by ordinary depth what lies beyond each: section 6)
//         for all lumels i:                                                  gather, Figure 5
//             H_i += 4 B_j max(n_i · d, 0),   j nearest of the lookups around i      Eq. (2)
//         now and then:  B ← E + ρ H from the running average                Figure 6
//
// Cost of a step: K parallel views of the scene, N × K lookups.
//
// Differs from the paper:
// - K directions per iteration, from a scrambled Sobol sequence over the sphere.
// - A running average in phases (iteration.cpp): a baked map must converge. With Scheme::paper
//   the source follows the average after every batch; SolverOptions::leak then gives the paper's
//   average.
// - Maps store lumels, not colours, so that emission and reflected light are gathered separately.
// - Layers::list stores every surface of a pixel, and Layers::peel renders one after the other
//   (C. Everitt. Interactive Order-Independent Transparency. 2001). Both are exact. Peeling stalls
//   in every batch, to read back one word: whether the last layer showed any lumel a new surface.
// - LookupTest::planes, the default, mends the test of Figure 5 on concave ground (see
//   directions.gather.comp). LookupTest::paper is the paper's.
// - Regions are slabs along d, within which surfaces compete (illumination_maps.h). Their number
//   follows from the measured overdraw (slabs.cpp).
// - With Scheme::phased rays find the light of small emissive surfaces
//   (directions_radiosity.cpp).
// - The sky is gathered with Scheme::paper only; otherwise it is part of the emission, by exact
//   views of its own (raster/shadow_maps/direct_light.h).

#include "methods/directions/directions.h"

#include <algorithm>
#include <bit>
#include <numbers>

#include "base/core/sphere.h"
#include "methods/directions/slabs.h"
#include "rays/paths/samples.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

constexpr std::uint32_t kChunk = 1024;
/// Dimension pairs of a direction's random numbers.
constexpr std::uint32_t kSlabDirectionPair = 0, kSlabOffsetPair = 1, kTurnPair = 2;
/// Maximum pixels of all maps of a batch, which limits their memory.
constexpr std::uint64_t kMaxPixels = 4u << 20;

/// Pixels of a map across a typical lumel. With fewer, pixel rays miss lumels seen edge-on; more
/// cost time.
constexpr float kPixelsPerLumel = 3.5f;

std::uint32_t map_side(const gpu::Device& device, const World& world, const Lumels& lumels,
                       const DirectionsOptions& options)
{
    return options.map_side > 0
               ? std::uint32_t(options.map_side)
               : parallel_side(lumels, world.diagonal(), kPixelsPerLumel, device.max_image_side());
}

std::uint32_t wanted_batch(const DirectionsOptions& options, std::uint32_t side,
                           std::uint32_t slabs)
{
    const std::uint64_t fit = kMaxPixels / (std::uint64_t(side) * side * maps_of_slabs(slabs));
    return std::uint32_t(
        std::clamp<std::uint64_t>(fit, 1, std::uint64_t(std::max(options.batch, 1))));
}

IlluminationMaps maps_for(const gpu::Device& device, const World& world, const Lumels& lumels,
                          const DirectionsOptions& options)
{
    const std::uint32_t side = map_side(device, world, lumels, options);
    const std::uint32_t slabs = suitable_slabs(device, world, side, options);
    return {device,
            world,
            options.layers,
            side,
            wanted_batch(options, side, slabs),
            std::uint32_t(lumels.width),
            std::uint32_t(lumels.height),
            slabs};
}

}  // namespace

GlobalDirections::GlobalDirections(const gpu::Device& device, const World& world,
                                   const Lumels& lumels, const DirectionsOptions& options,
                                   std::span<const glm::vec3> known)
    : options_(options),
      device_(&device),
      world_(&world),
      maps_(maps_for(device, world, lumels, options)),
      batch_(std::bit_floor(maps_.capacity())),
      gather_(device, std::uint32_t(options.layers)),
      lumel_of_(device, view(lumels_by_side(lumels))),
      seen_(device,
            options.layers == Layers::peel ? std::size_t(batch_) * lumels.lumels.size() : 0),
      news_(device, 1),
      seen_light_(device, lumels.lumels.size()),
      iteration_(device, lumels, NearField{}, known, options.iteration, batch_),
      pacer_(device)
{
    gpu::Commands commands(device);
    commands.fill(seen_light_.buffer());
    commands.run();
    iteration_.begin(pacer_);
}

GlobalDirections::Chunk GlobalDirections::make_chunk(std::uint32_t half, std::uint32_t first) const
{
    const bool with_sky = options_.iteration.scheme == Scheme::paper && options_.sky;
    // Channels take turns, so that each uses a complete sequence.
    const bool in_turn = world_->has_coloured_glass();
    std::vector<ParallelView> views;
    std::vector<GlobalDirection> directions;
    const std::uint32_t stream = PathSamples::hash(options_.seed, half);
    for (std::uint32_t i = first; i < first + kChunk; ++i) {
        const PathSamples samples(stream, in_turn ? i / kChannels : i);
        const glm::vec3 way = on_sphere(samples.stratified(kSlabDirectionPair));
        const glm::vec3 toward(way.x, way.z, way.y);  // strata go from the zenith down
        const float turn = 2.0f * std::numbers::pi_v<float> * samples.random(kTurnPair).x;
        views.push_back(fit_view(world_->low(), world_->high(), maps_.layout().side,
                                 {.toward = toward,
                                  .turn = turn,
                                  .offset = samples.random(kSlabOffsetPair),
                                  .random = samples.bits(kTurnPair),
                                  .channel = in_turn ? 1 + i % kChannels : kAllChannels}));
        directions.push_back(
            {toward, with_sky ? sky_radiance(world_->sky(), toward) : glm::vec3(0.0f)});
    }
    return {gpu::Array<ParallelView>(*device_, std::span<const ParallelView>(views)),
            gpu::Array<GlobalDirection>(*device_, std::span<const GlobalDirection>(directions)),
            first};
}

const GlobalDirections::Chunk& GlobalDirections::chunk_of(std::uint32_t half, std::uint32_t index)
{
    std::deque<Chunk>& chunks = chunks_[half];
    if (chunks.empty() || index >= chunks.back().first + kChunk) {
        chunks.push_back(make_chunk(half, index / kChunk * kChunk));
        if (chunks.size() > 2) {
            pacer_.finish();  // the oldest may be in use
            chunks.pop_front();
        }
    }
    return chunks.back();
}

std::uint64_t GlobalDirections::device_bytes(const SolveSize& size,
                                             const DirectionsOptions& options)
{
    const std::uint32_t side = options.map_side > 0
                                   ? std::uint32_t(options.map_side)
                                   : parallel_side(*size.lumels, size.diagonal, kPixelsPerLumel);
    const std::uint32_t slabs =
        options.layers == Layers::stochastic ? std::max(options.slabs, 1u) : 1;
    const std::uint32_t maps = wanted_batch(options, side, slabs);
    const std::uint64_t seen =
        options.layers == Layers::peel ? std::bit_floor(maps) * size.count() : 1;
    // Two chunks of directions per half, and one under construction.
    constexpr std::uint64_t kChunks = 5;
    return IlluminationMaps::device_bytes(options.layers, side, maps, slabs) +
           kChunks * kChunk * (sizeof(ParallelView) + sizeof(GlobalDirection)) +
           (2 * size.texels() + seen + 1) * sizeof(std::uint32_t) +
           size.count() * sizeof(SeenLight) + Iteration::device_bytes(size.count(), 0);
}

void GlobalDirections::step()
{
    iteration_.begin_batch(pacer_);
    const Chunk& chunk = chunk_of(iteration_.half(), iteration_.emission_index());
    const std::uint32_t first = iteration_.emission_index() - chunk.first;
    if (options_.layers == Layers::peel)
        peel(chunk, first);
    else
        maps_.look_along(pacer_, chunk.views, first, batch_);
    gather(chunk, first);
    iteration_.finish_batch(pacer_, batch_, iteration_.sends_reflected() ? batch_ : 0);
}

/// Renders layers until one shows no lumel a new surface: those behind it cannot either. Checks
/// only from the number of layers needed so far.
void GlobalDirections::peel(const Chunk& chunk, std::uint32_t first_view)
{
    bool more = true;
    for (std::uint32_t layer = 0; more; ++layer) {
        maps_.look_along(pacer_, chunk.views, first_view, batch_, layer);
        pacer_.work("clear news",
                    [this](gpu::Commands& commands) { commands.fill(news_.buffer()); });
        gather(chunk, first_view, layer, true);
        if (layer + 1 < layers_)
            continue;
        layers_ = layer + 1;
        pacer_.finish();
        more = news_.download()[0] != 0;
    }
}

void GlobalDirections::gather(const Chunk& chunk, std::uint32_t first_view, std::uint32_t layer,
                              bool keep)
{
    pacer_.dispatch_parts(keep ? "keep" : "gather", iteration_.lumels(), kProbeLumels, gather_,
                          {.lumels = world_->lumels(),
                           .pieces = world_->pieces(),
                           .views = chunk.views,
                           .directions = chunk.directions,
                           .illumination_map = {maps_.image(layer), maps_.sampler()},
                           .heads = maps_.heads(),
                           .fragments = maps_.fragments(),
                           .lumel_of = lumel_of_,
                           .emission = iteration_.emission(),
                           .source = iteration_.source(),
                           .direct = iteration_.direct(),
                           .indirect = iteration_.indirect(),
                           .kept = seen_,
                           .news = news_,
                           .seen_light_of = seen_light_},
                          {.tiling = maps_.layout(),
                           .count = iteration_.lumels(),
                           .first_view = first_view,
                           .views = batch_,
                           .half_index = iteration_.half(),
                           .first_point = std::uint32_t(iteration_.state().shots),
                           .seed = options_.seed,
                           .centre = options_.rule == SampleRule::centre ? 1u : 0u,
                           .neighbours = std::uint32_t(options_.lookups / 2),
                           .by_planes = options_.lookup_test == LookupTest::planes ? 1u : 0u,
                           .with_emission = options_.iteration.scheme == Scheme::paper ? 0u : 1u,
                           .with_source = iteration_.sends_reflected() ? 1u : 0u,
                           .layer = layer,
                           .keep = keep ? 1u : 0u,
                           .slabs = maps_.slabs(),
                           .maps = maps_of_slabs(maps_.slabs())});
}

void GlobalDirections::relight(const Lumels& lumels)
{
    iteration_.relight(pacer_, lumels);
    pacer_.finish();
    for (std::deque<Chunk>& chunks : chunks_)
        chunks.clear();  // they hold the sky
}

std::vector<glm::vec3> GlobalDirections::irradiance()
{
    std::vector<glm::vec3> irradiance = iteration_.irradiance(pacer_);
    if (options_.layers == Layers::list && maps_.kept() < 1.0)
        throw Error(ErrorKind::device, "--layers list",
                    "out of memory for overlapping surfaces; use --layers peel or stochastic");
    return irradiance;
}

}  // namespace lumel
