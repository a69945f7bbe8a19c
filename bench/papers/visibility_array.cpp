// [BJ04] figures 2 and 3: the visibility array, which has the patch of every texel, and the depth
// image that a shooter takes of the scene through a hemisphere.

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "bench/papers/figures.h"
#include "raster/eyes/probe.h"
#include "rays/paths/samples.h"
#include "results/preview/preview.h"

namespace lumel::bench {
namespace {

/// Texels of one chart, the paper's patch, have one color; others are black.
Image visibility_array(const SolveScene& world)
{
    constexpr float kDarkest = 0.2f;
    constexpr std::uint32_t kByte = 255u;
    Image image(world.atlas.width, world.atlas.height, 3);
    for (const Lumel& lumel : world.lumels.lumels) {
        const std::uint32_t bits = PathSamples::hash(lumel.chart, 0u);
        float* pixel = &image.values[3 * std::size_t(lumel.texel)];
        for (int c = 0; c < 3; ++c)
            pixel[c] = kDarkest + (1.0f - kDarkest) * float((bits >> (8 * c)) & kByte) / kByte;
    }
    return image;
}

/// The texel that sends the most light.
const Lumel& brightest(const Lumels& lumels)
{
    return *std::max_element(lumels.lumels.begin(), lumels.lumels.end(),
                             [](const Lumel& a, const Lumel& b) {
                                 return luminance(a.emission) < luminance(b.emission);
                             });
}

/// near / distance of what the texel sees, nearer is brighter; black: nothing.
Image depth_image(const gpu::Device& device, const SolveScene& world, int side)
{
    const World resident(device, world.scene, world.lumels);
    const Lumel& shooter = brightest(world.lumels);
    const std::array eye{eye_at(shooter.position, shooter.normal)};
    const gpu::Array<Eye> eyes(device, std::span<const Eye>(eye));
    EyeViews views(device, resident, Projection::hemisphere, std::uint32_t(side), 1);
    gpu::Pacer pacer(device);
    views.look_from(pacer, eyes, 1);
    pacer.finish();
    std::vector<float> nearness(std::size_t(views.image().width()) * views.image().height());
    views.image().download(nearness.data());
    const float nearest = *std::max_element(nearness.begin(), nearness.end());
    Image image(int(views.image().width()), int(views.image().height()), 3);
    for (std::size_t i = 0; i < nearness.size(); ++i)
        std::fill_n(&image.values[3 * i], 3, nearest > 0.0f ? nearness[i] / nearest : 0.0f);
    return image;
}

}  // namespace

void show_visibility(const VisibilitySettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const SolveScene world = prepare(settings.shared, settings.shared.size);
    std::filesystem::create_directories(settings.folder);
    report.say(fmt::format("{}, {} lumels at {}², {}", settings.shared.scene,
                           world.lumels.lumels.size(), world.atlas.width, words_of(device)));
    const auto show = [&](const char* name, const Image& image, const char* caption) {
        const std::string path = settings.folder + "/" + name;
        write_png(path, image);
        report.picture(path, caption);
    };
    show("visibility-array.png", visibility_array(world),
         "[BJ04] figure 2: the chart of every texel by its color");
    show("shooter-depth.png",
         depth_image(device, world, views_of(settings.shared.given.options()).hemicube),
         "[BJ04] figure 3: what a texel of the lamp sees through the hemisphere, nearer is "
         "brighter");
    device.check_validation();
}

}  // namespace lumel::bench
