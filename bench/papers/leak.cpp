// [TN11] section 5: leaky integration beside the mean of all directions, and how it follows light
// that changes.

#include <cmath>
#include <cstdio>

#include <fmt/core.h>

#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/moving.h"
#include "reference/metrics.h"
#include "scene/light_options.h"
#include "solve/directions.h"

namespace lumel::bench {
namespace {

/// What is left of the sky once it changes.
constexpr float kDimmed = 0.25f;
/// How much more directions than the figure's last row the truth has.
constexpr int kTruthDirections = 8;

/// A solver that goes on to a number of directions.
class Gathering {
public:
    Gathering(const gpu::Device& device, const Prepared& prepared, const World& world,
              const DirectionsOptions& options)
        : lumels_(&prepared.lumels),
          solver_(device, world, prepared.lumels, options)
    {
    }

    void go_to(int directions)
    {
        while (solver_.state().shots < std::uint64_t(directions))
            solver_.step();
    }
    void relight() { solver_.relight(*lumels_); }
    Image map(float scale = 1.0f)
    {
        std::vector<glm::vec3> irradiance = solver_.irradiance();
        for (glm::vec3& h : irradiance)
            h *= scale;
        return in_a_row(*lumels_, irradiance);
    }

private:
    const Lumels* lumels_;
    GlobalDirections solver_;
};

DirectionsOptions options_for(const LeakSettings& settings, double leak)
{
    auto options = options_of<DirectionsOptions>(settings.shared);
    options.batch = 1;
    options.iteration = {Scheme::paper, leak};
    return options;
}

std::string text_of(const MapError& error)
{
    return fmt::format("{:.1f} | {:+.1f}", 100.0 * error.relative_rmse, 100.0 * error.bias);
}

}  // namespace

void follow_light(const LeakSettings& settings)
{
    const gpu::Device device(settings.shared.device);
    LightOptions white;
    white.sky_color = glm::vec3(1.0f);
    Prepared prepared(read_scene(settings.shared.scene, MaterialModel::diffuse, white),
                      AtlasOptions{.size = settings.shared.size});
    const World world(device, prepared.scene, prepared.lumels, &prepared.atlas);
    DirectionsOptions of_truth = options_for(settings, 0.0);
    of_truth.seed += 1;
    Gathering truth(device, prepared, world, of_truth);
    truth.go_to(kTruthDirections * settings.directions.back());
    Gathering mean(device, prepared, world, options_for(settings, 0.0));
    Gathering leaky(device, prepared, world, options_for(settings, settings.leak));

    fmt::print("{}, {} lumels at {}², maps of {}², a leak of {}, {} ({})\n\n"
               "| directions | mean, RMSE % | bias % | leaky, RMSE % | bias % |\n"
               "|---|---|---|---|---|\n",
               settings.shared.scene, prepared.lumels.lumels.size(), prepared.atlas.width,
               of_truth.map_side, settings.leak, device.info().name, device.info().driver);
    for (const int directions : settings.directions) {
        mean.go_to(directions);
        leaky.go_to(directions);
        fmt::print("| {} | {} | {} |\n", directions, text_of(compare_maps(mean.map(), truth.map())),
                   text_of(compare_maps(leaky.map(), truth.map())));
        std::fflush(stdout);
    }
    for (glm::vec3& radiance : prepared.scene.sky.radiance)
        radiance *= kDimmed;
    leaky.relight();
    fmt::print("\n| directions since the sky dimmed to {} | leaky, RMSE % | bias % "
               "| of the old light's, % |\n|---|---|---|---|\n",
               kDimmed);
    for (const int directions : settings.directions) {
        leaky.go_to(settings.directions.back() + directions);
        const double left = std::pow(1.0 - settings.leak, directions);
        fmt::print("| {} | {} | {:+.1f} |\n", directions,
                   text_of(compare_maps(leaky.map(), truth.map(kDimmed))),
                   100.0 * left * (1.0 / double(kDimmed) - 1.0));
        std::fflush(stdout);
    }
    device.check_validation();
}

}  // namespace lumel::bench
