// [TN11] section 5: leaky integration beside the mean of all directions, and how it follows light
// that changes.

#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "atlas/near/still_part.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/moving.h"
#include "bench/papers/our_default.h"
#include "bench/stopwatch.h"
#include "methods/directions/directions.h"
#include "methods/directions/leaky_scene.h"
#include "scene/sky/light_options.h"
#include "truth/metrics.h"

namespace lumel::bench {
namespace {

/// What is left of the sky once it changes.
constexpr float kDimmed = 0.25f;
/// How much more directions than the figure's last row the truth has.
constexpr int kTruthDirections = 8;

/// A solver that goes on to a number of directions.
class Gathering {
public:
    Gathering(const gpu::Device& device, const Lumels& lumels, const World& world,
              const DirectionsOptions& options)
        : lumels_(&lumels),
          solver_(device, world, lumels, options)
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

Cell by_our_default(const gpu::Device& device, const SolveScene& world, const Image& truth)
{
    const Solved ours = solve_by_default(device, world);
    return words_of(compare_maps(in_a_row(world.lumels, ours.irradiance), truth).relative_rmse,
                    ours.cpu);
}

Cell rmse_of(const MapError& error)
{
    return fixed(100.0 * error.relative_rmse, 1);
}

Cell bias_of(const MapError& error)
{
    return signed_fixed(100.0 * error.bias, 1);
}

constexpr const char* kMoved = "white cube";
const glm::vec3 kShift(0.4f, 0.3f, 0.4f);  // [m]

/// A cube that moves while lumel's LeakyScene goes on, against the mean of many directions with it
/// in its new place.
void follow_a_move(const LeakSettings& settings, const gpu::Device& device, const Scene& scene,
                   Report& report)
{
    const std::uint32_t cube = find_instance(scene, kMoved);
    const glm::mat4 place =
        glm::translate(glm::mat4(1.0f), kShift) * scene.instances[cube].transform;
    LeakyOptions options{.solver = options_for(settings, settings.leak), .leak = settings.leak};
    options.atlas.size = settings.shared.size;
    options.movers = {cube};
    LeakyScene live(device, scene, options);
    live.settle();
    Scene posed = scene;
    posed.instances[cube].transform = place;
    // In the atlas of the scene as it was, so that lumels are the same.
    std::vector<char> moves(posed.instances.size());
    moves[cube] = 1;
    const Lumels lumels = make_lumels(posed, live.atlas(), moves);
    const World world(device, posed, lumels, &live.atlas());
    DirectionsOptions of_truth = options_for(settings, 0.0);
    of_truth.seed += 1;
    Gathering truth(device, lumels, world, of_truth);
    truth.go_to(kTruthDirections * settings.directions.back());

    report.table(
        "moved",
        fmt::format("After a cube moved by {:.2f} m, one direction an update", glm::length(kShift)),
        {"directions since", "leaky, RMSE %", "leaky, bias %", "cpu ms a direction"},
        by_our_default(device, {posed, live.atlas(), lumels}, truth.map()));
    live.move(cube, place);
    const std::uint64_t before = live.update(0.0).hemicubes - 1;
    Stopwatch watch;
    for (const int directions : settings.directions) {
        std::uint64_t since = 1;
        watch.start();
        while (since < std::uint64_t(directions)) {
            const LiveState state = live.update(0.0);
            if (state.at_rest)
                break;
            since = state.hemicubes - before;
        }
        watch.stop();
        const MapError error =
            compare_maps(in_a_row(live.lumels(), live.irradiance()), truth.map());
        report.row({int(since), rmse_of(error), bias_of(error),
                    fixed(1e3 * watch.cpu / double(since), 2)});
    }
}

}  // namespace

void follow_light(const LeakSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    LightOptions white;
    white.sky_color = glm::vec3(1.0f);
    SolveScene prepared(read_scene(settings.shared.scene, MaterialModel::diffuse, white),
                        AtlasOptions{.size = settings.shared.size});
    const World world(device, prepared.scene, prepared.lumels, &prepared.atlas);
    DirectionsOptions of_truth = options_for(settings, 0.0);
    of_truth.seed += 1;
    Gathering truth(device, prepared.lumels, world, of_truth);
    truth.go_to(kTruthDirections * settings.directions.back());
    Gathering mean(device, prepared.lumels, world, options_for(settings, 0.0));
    Gathering leaky(device, prepared.lumels, world, options_for(settings, settings.leak));

    report.say(fmt::format("{}, {} lumels at {}², maps of {}², a leak of {}, {}",
                           settings.shared.scene, prepared.lumels.lumels.size(),
                           prepared.atlas.width, of_truth.map_side, settings.leak,
                           words_of(device)));
    report.table("leak", "The mean and the leaky mean ([TN11] section 5)",
                 {"directions", "mean, RMSE %", "mean, bias %", "leaky, RMSE %", "leaky, bias %"},
                 by_our_default(device, prepared, truth.map()));
    for (const int directions : settings.directions) {
        mean.go_to(directions);
        leaky.go_to(directions);
        const MapError of_mean = compare_maps(mean.map(), truth.map());
        const MapError of_leaky = compare_maps(leaky.map(), truth.map());
        report.row(
            {directions, rmse_of(of_mean), bias_of(of_mean), rmse_of(of_leaky), bias_of(of_leaky)});
    }
    for (glm::vec3& radiance : prepared.scene.sky.radiance)
        radiance *= kDimmed;
    leaky.relight();
    report.table("dimmed", fmt::format("After the sky dimmed to {}", kDimmed),
                 {"directions since", "leaky, RMSE %", "leaky, bias %", "of the old light's, %"},
                 "scales exactly");
    for (const int directions : settings.directions) {
        leaky.go_to(settings.directions.back() + directions);
        const double left = std::pow(1.0 - settings.leak, directions);
        const MapError error = compare_maps(leaky.map(), truth.map(kDimmed));
        report.row({directions, rmse_of(error), bias_of(error),
                    signed_fixed(100.0 * left * (1.0 / double(kDimmed) - 1.0), 1)});
    }
    for (glm::vec3& radiance : prepared.scene.sky.radiance)
        radiance /= kDimmed;
    follow_a_move(settings, device, prepared.scene, report);
    device.check_validation();
}

}  // namespace lumel::bench
