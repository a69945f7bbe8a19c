#include "raster/shadow_maps/direct_light.h"

#include <algorithm>
#include <optional>

#include "raster/shadow_maps/lamps.h"
#include "raster/shadow_maps/parallel_light.h"

namespace lumel {
namespace {

bool is_parallel(const PunctualLight& light)
{
    return light.kind == PunctualLight::Kind::directional;
}

/// Pixels of a view across a typical lumel. In the city of scenes/ under a uniform sky, 5 give an
/// error of 1.1 %, and 3.5 one of 1.8 %, in three quarters of the time.
constexpr float kPixelsPerLumel = 5.0f;

/// Directions of each source of parallel light.
std::vector<std::vector<ParallelSource>> parallel_sources(const Scene& scene,
                                                          const DirectLightOptions& options)
{
    std::vector<std::vector<ParallelSource>> sources{
        sky_sources(scene.sky, options.sky_directions, options.seed)};
    for (const PunctualLight& light : scene.lights) {
        if (!is_parallel(light) || !shines(light))
            continue;
        const std::uint32_t count =
            light.angle > 0.0f ? options.disc_directions : options.sun_directions;
        sources.push_back(sun_sources(light, count, options.seed));
    }
    return sources;
}

}  // namespace

bool has_lights(const Scene& scene)
{
    return !scene.sky.empty() || !scene.lights.empty();
}

std::uint64_t direct_light_bytes(const Scene& scene, const Lumels& lumels, float diagonal)
{
    std::uint64_t pixels = 0;
    if (!scene.sky.empty() || std::any_of(scene.lights.begin(), scene.lights.end(), is_parallel))
        pixels = parallel_light_pixels({.side = parallel_side(lumels, diagonal, kPixelsPerLumel)});
    if (!std::all_of(scene.lights.begin(), scene.lights.end(), is_parallel))
        pixels = std::max(pixels, lamp_pixels({}));
    const std::uint64_t sums = has_lights(scene) ? SummedLight::bytes(lumels.lumels.size()) : 0;
    return sums + pixels * sizeof(float);
}

struct DirectLightSearch::Data {
    const gpu::Device* device;
    const World* world;
    const Scene* scene;
    DirectLightOptions options;
    ParallelLightOptions parallel_options;
    std::vector<std::vector<ParallelSource>> sources;
    SummedLight summed;
    std::size_t part = 0;  ///< index of the source; all lamps are one, the last
    std::optional<ParallelLight> parallel;
    std::optional<LampLight> lamps;

    bool is_done() const { return part > sources.size(); }

    /// Starts the next source with work to do.
    void begin()
    {
        parallel.reset();
        lamps.reset();
        while (part < sources.size() && sources[part].empty())
            ++part;
        if (part < sources.size())
            parallel.emplace(*device, *world, sources[part], parallel_options, summed);
        if (part != sources.size())
            return;
        lamps.emplace(*device, *world, *scene,
                      LampOptions{.seed = options.seed, .centre = options.centre}, summed);
        if (lamps->is_done())
            ++part;
    }
};

DirectLightSearch::DirectLightSearch(const gpu::Device& device, const World& world,
                                     const Scene& scene, const Lumels& lumels,
                                     const DirectLightOptions& options)
    : data_(new Data{
          .device = &device,
          .world = &world,
          .scene = &scene,
          .options = options,
          .parallel_options = {.side = parallel_side(lumels, world.diagonal(), kPixelsPerLumel,
                                                     device.max_image_side()),
                               .seed = options.seed,
                               .centre = options.centre},
          .sources = parallel_sources(scene, options),
          .summed = {device, lumels.lumels.size()}})
{
    data_->begin();
}

DirectLightSearch::~DirectLightSearch() = default;

void DirectLightSearch::step(std::uint64_t pixels)
{
    if (data_->parallel)
        data_->parallel->step(pixels);
    else
        data_->lamps->step(pixels);
    if (data_->parallel ? !data_->parallel->is_done() : !data_->lamps->is_done())
        return;
    ++data_->part;
    data_->begin();
}

void DirectLightSearch::wait()
{
    if (data_->parallel)
        data_->parallel->wait();
    else if (!data_->is_done())
        data_->lamps->wait();
}

bool DirectLightSearch::is_done() const
{
    return data_->is_done();
}

double DirectLightSearch::done() const
{
    if (is_done())
        return 1.0;
    const double of_part = data_->parallel ? data_->parallel->done() : data_->lamps->done();
    return (double(data_->part) + of_part) / (double(data_->sources.size()) + 1.0);
}

DirectLight DirectLightSearch::take()
{
    const bool finished = is_done();
    if (!finished && data_->parallel)
        data_->parallel->finish();
    else if (!finished)
        data_->lamps->finish();
    return {data_->summed.irradiance(), data_->summed.times(), finished};
}

DirectLight direct_light(const gpu::Device& device, const World& world, const Scene& scene,
                         const Lumels& lumels, const DirectLightOptions& options,
                         const std::function<bool(double)>& go_on)
{
    DirectLightSearch search(device, world, scene, lumels, options);
    bool going = true;
    while (!search.is_done() && going) {
        search.step(kMaxLightPixels);
        going = !go_on || go_on(search.done());
    }
    return search.take();
}

}  // namespace lumel
