#include "jobs/solve/dump.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "atlas/finish/finish.h"
#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "raster/eyes/eye_views.h"
#include "raster/eyes/probe.h"
#include "raster/parallel/illumination_maps.h"
#include "results/record/origin.h"

namespace lumel {
namespace {

constexpr std::uint32_t kMaxLayers = 4;        ///< maximum layers of the illumination map written
constexpr float kPixelsPerLumel = 2.0f;        ///< across a typical lumel in the illumination map
constexpr std::uint32_t kLargestSide = 2048u;  ///< side of the illumination map [pixels]

/// An image and the meaning of its numbers.
struct Picture {
    std::string name, quantity, unit;
    Image numbers;
    Image look;  ///< shown instead, linear; empty: the numbers themselves
};

void write(const OutputFolder& folder, const Picture& picture)
{
    write_exr(folder.path(picture.name + ".exr"), picture.numbers, Precision::float32,
              {{"quantity", picture.quantity},
               {"unit", picture.unit},
               {"software", "lumel " + lumel_version()}});
    write_png(folder.path(picture.name + ".png"),
              tone_map(picture.look.values.empty() ? picture.numbers : picture.look));
}

/// B [N] [lm/m²]
std::vector<glm::vec3> radiosity_of(const Lumels& lumels, std::span<const glm::vec3> irradiance)
{
    std::vector<glm::vec3> radiosity;
    radiosity.reserve(irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        radiosity.push_back(lumels.lumels[i].emission + lumels.lumels[i].albedo * irradiance[i]);
    return radiosity;
}

/// B A [N] [lm]; 0 for buried lumels.
std::vector<glm::vec3> power_of(const Lumels& lumels, std::span<const glm::vec3> radiosity)
{
    std::vector<glm::vec3> power(radiosity.begin(), radiosity.end());
    for (std::size_t i = 0; i < power.size(); ++i)
        power[i] *= (lumels.lumels[i].flags & kLumelBuried) ? 0.0f : lumels.lumels[i].area;
    return power;
}

std::size_t brightest(std::span<const glm::vec3> power)
{
    const auto dimmer = [](const glm::vec3& a, const glm::vec3& b) {
        return luminance(a) < luminance(b);
    };
    return std::size_t(std::max_element(power.begin(), power.end(), dimmer) - power.begin());
}

Image grey(const gpu::Target& like)
{
    return {int(like.width()), int(like.height()), 3};
}

void set_grey(Image& image, std::size_t pixel, float value)
{
    std::fill_n(image.values.begin() + std::ptrdiff_t(3 * pixel), 3, value);
}

/// View from the lumel's own point.
Picture view_from(const gpu::Device& device, const World& world, std::size_t lumel,
                  const ViewOptions& options)
{
    const Lumel at = world.lumels().download()[lumel];
    const std::array eye{eye_at(at.position, at.normal)};
    const gpu::Array<Eye> eyes(device, std::span<const Eye>(eye));
    EyeViews views(device, world, options.projection, std::uint32_t(options.hemicube), 1);
    gpu::Pacer pacer(device);
    views.look_from(pacer, eyes, 1);
    pacer.finish();

    const bool hemisphere = options.projection == Projection::hemisphere;
    Picture picture{hemisphere ? "hemisphere" : "hemicube",
                    hemisphere ? "distance" : "distance along the face's axis", "m",
                    grey(views.image()), grey(views.image())};
    std::vector<float> nearness(std::size_t(views.image().width()) * views.image().height());
    views.image().download(nearness.data());
    for (std::size_t i = 0; i < nearness.size(); ++i) {
        set_grey(picture.numbers, i, nearness[i] > 0.0f ? views.layout().near / nearness[i] : 0.0f);
        set_grey(picture.look, i, nearness[i]);
    }
    return picture;
}

/// Colours of an illumination map's pixels, given as (surface, nearness).
Image colours_of(std::span<const glm::uvec2> pixels, std::uint32_t side, const Lumels& lumels,
                 std::span<const glm::vec3> radiosity)
{
    const std::vector<std::uint32_t> lumel_of = lumels_by_side(lumels);
    Image image = Image(int(side), int(side), 4);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::uint32_t surface = pixels[i].x;
        if (surface == 0)
            continue;
        float* pixel = image.values.data() + 4 * i;
        pixel[3] = 1.0f;
        const std::uint32_t lumel = surface == kAbsorbing ? kNoLumel : lumel_of[surface - 1];
        if (lumel != kNoLumel)
            for (int c = 0; c < 3; ++c)
                pixel[c] = radiosity[lumel][c];
    }
    return image;
}

void write_illumination(const OutputFolder& folder, const gpu::Device& device, const World& world,
                        const Lumels& lumels, std::span<const glm::vec3> radiosity)
{
    const std::uint32_t side = parallel_side(lumels, world.diagonal(), kPixelsPerLumel,
                                             std::min(kLargestSide, device.max_image_side()));
    IlluminationMaps maps(device, world, Layers::peel, side, 1, std::uint32_t(lumels.width),
                          std::uint32_t(lumels.height));
    const std::array view{fit_view(world.low(), world.high(), side, {})};
    const gpu::Array<ParallelView> views(device, std::span<const ParallelView>(view));
    gpu::Pacer pacer(device);
    std::vector<glm::uvec2> pixels(std::size_t(side) * side);
    for (std::uint32_t layer = 0; layer < kMaxLayers; ++layer) {
        maps.look_along(pacer, views, 0, 1, layer);
        pacer.finish();
        maps.image(layer).download(pixels.data());
        if (std::all_of(pixels.begin(), pixels.end(), [](auto& pixel) { return pixel.x == 0; }))
            return;
        write(folder, {"illumination-" + std::to_string(layer + 1),
                       "exitance",
                       "lm/m2",
                       colours_of(pixels, side, lumels, radiosity),
                       {}});
    }
}

/// Σ_j F_ij over close pairs [N].
std::vector<glm::vec3> row_sums(const NearField& near)
{
    std::vector<glm::vec3> sums(near.first.size() - 1, glm::vec3(0.0f));
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = glm::vec3(float(std::accumulate(near.factor.begin() + near.first[i],
                                                  near.factor.begin() + near.first[i + 1], 0.0)));
    return sums;
}

}  // namespace

void write_dump(OutputFolder& folder, const gpu::Device& device, const Setting& setting,
                std::span<const glm::vec3> irradiance, const SolverOptions& options)
{
    const Lumels& lumels = setting.prepared.lumels;
    const World& world = *setting.world;
    const std::vector<glm::vec3> radiosity = radiosity_of(lumels, irradiance);
    const std::vector<glm::vec3> power = power_of(lumels, radiosity);
    write(folder, view_from(device, world, brightest(power), views_of(options.method)));
    write_illumination(folder, device, world, lumels, radiosity);
    const NearField& near = setting.near;
    if (!near.column.empty())
        write(folder,
              {"near", "form factor of close pairs", "1", to_map(lumels, row_sums(near)), {}});
    write(folder, {"power", "power", "lm", to_map(lumels, power), {}});
    folder.commit();
}

}  // namespace lumel
