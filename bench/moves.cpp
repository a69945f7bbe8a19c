// What it costs that something moves: rays and close pairs, of what moved and all anew.

#include <algorithm>
#include <array>
#include <functional>

#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>

#include "atlas/near/moving_near_field.h"
#include "bench/modes.h"
#include "bench/stopwatch.h"

namespace lumel::bench {
namespace {

/// Times that the thing moves, and by so much of its size each time.
constexpr int kTimes = 7;
constexpr float kStep = 0.15f;

/// Processor time of some work [ms].
double cost_of(const std::function<void()>& work)
{
    Stopwatch watch;
    watch.start();
    work();
    watch.stop();
    return 1e3 * watch.cpu;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

Box box_of(const Scene& scene, std::uint32_t instance)
{
    const RayScene alone(scene, std::span(&instance, 1));
    return {alone.low(), alone.high()};
}

/// As it was before pairs were chosen: all of lumels that a pair through what moved may have.
NearField near_field_around(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                            std::span<const Box> boxes)
{
    float largest = 0.0f;
    for (const Lumel& lumel : lumels.lumels)
        largest = std::max(largest, lumel.size);
    const float reach = NearFieldOptions{}.radius * largest;
    std::vector<char> chosen;
    for (const Lumel& lumel : lumels.lumels) {
        const glm::vec3 at(scene.instances[lumel.instance].transform *
                           glm::vec4(lumel.position, 1.0f));
        chosen.push_back(std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
            return box.distance2(at) < reach * reach;
        }));
    }
    return build_near_field_among(chosen, scene, rays, lumels, {});
}

}  // namespace

void time_moves(const Settings& settings)
{
    const SolveScene prepared = prepare(settings, settings.size);
    const Lumels& lumels = prepared.lumels;
    Scene scene = prepared.scene;
    const std::uint32_t thing = find_instance(scene, settings.moves);
    std::vector<char> movers(scene.instances.size(), 0);
    movers[thing] = 1;
    RayScene rays(scene, movers);
    MovingNearField near(scene, rays, lumels, {}, movers, NearPairsOf::all);
    std::vector<double> all_rays, all_pairs, pairs_around, rays_moved, pairs_moved;
    for (int n = 0; n < kTimes; ++n) {
        const Box before = box_of(scene, thing);
        const float step = kStep * 2.0f * before.radius() * (n % 2 == 0 ? 1.0f : -0.5f);
        scene.instances[thing].transform =
            glm::translate(glm::mat4(1.0f), glm::vec3(step, 0.0f, 0.5f * step)) *
            scene.instances[thing].transform;
        const std::array boxes{before, box_of(scene, thing)};
        rays_moved.push_back(cost_of([&] { rays.place(std::span(&thing, 1)); }));
        pairs_moved.push_back(
            cost_of([&] { near.follow(scene, rays, std::span(&thing, 1), boxes); }));
        all_rays.push_back(cost_of([&] { const RayScene anew(scene); }));
        pairs_around.push_back(cost_of([&] { near_field_around(scene, rays, lumels, boxes); }));
    }
    const RayScene one_tree(scene);
    NearField anew;
    all_pairs.push_back(cost_of([&] { anew = build_near_field(scene, one_tree, lumels, {}); }));
    fmt::print("{} at {}: {} lumels, {} close pairs, {} instances\n", settings.scene, settings.size,
               lumels.lumels.size(), anew.column.size(), scene.instances.size());
    fmt::print("{:<28} {:>10} {:>10}\n", "processor time [ms] of", "rays", "pairs");
    fmt::print("{:<28} {:>10.2f} {:>10.2f}\n", "all anew", median(all_rays), median(all_pairs));
    fmt::print("{:<28} {:>10} {:>10.2f}\n", "all pairs around", "", median(pairs_around));
    fmt::print("{:<28} {:>10.2f} {:>10.2f}\n", "a move of " + settings.moves, median(rays_moved),
               median(pairs_moved));
    fmt::print("the same table: {}\n",
               near.table().column == anew.column && near.table().factor == anew.factor ? "yes"
                                                                                        : "no");
}

}  // namespace lumel::bench
