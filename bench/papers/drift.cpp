// Errors of incremental and of cross-redistribution radiosity must not pile up [Hoef13] 4.5.2.

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "base/core/error.h"
#include "bench/papers/figures.h"
#include "bench/papers/moving.h"
#include "truth/metrics.h"

namespace lumel::bench {
namespace {

/// A place so far away that the box has no effect [m].
constexpr glm::vec3 kAway{0.0f, 1000.0f, 0.0f};

double apart(const LiveScene& live, const Image& first)
{
    return 100.0 * compare_maps(in_a_row(live.lumels(), live.irradiance()), first).relative_rmse;
}

/// Is it one of 2, 10, 100, …?
bool is_looked_at(int move, int moves)
{
    int power = 10;
    while (power < move)
        power *= 10;
    return move == 2 || move == power || move == moves;
}

void follow(const gpu::Device& device, const Scene& scene, Redistribution redistribution,
            const DriftSettings& settings, Report& report)
{
    const std::uint32_t box = find_instance(scene, kBox);
    LiveScene live(device, scene,
                   {.atlas = {.size = settings.shared.size},
                    .redistribution = redistribution,
                    .solver = options_of<ProgressiveOptions>(settings.shared),
                    .movers = {box},
                    .residual = settings.residual});
    live.settle();
    const char* name = redistribution == Redistribution::cross ? "cross" : "incremental";
    const auto add = [&](const std::string& after, double error) {
        report.row({name, after, fixed(error, 4), fixed(live.state().residual, 4)});
    };
    const glm::mat4 home = scene.instances[box].transform;
    const auto before = in_a_row(live.lumels(), live.irradiance());
    const std::pair<const char*, glm::mat4> places[] = {
        {"away", glm::translate(glm::mat4(1.0f), kAway) * home}, {"put back", home}};
    for (const auto& [after, place] : places) {
        live.move(box, place);
        live.settle();
        add(after, apart(live, before));
    }
    const Image first = in_a_row(live.lumels(), live.irradiance());
    for (int move = 1; move <= settings.moves; ++move) {
        live.move(box, move % 2 == 1 ? turned(scene, box, settings.degrees) : home);
        live.settle();
        if (is_looked_at(move, settings.moves))
            add(move == settings.moves ? "the last move" : fmt::format("{} moves", move),
                apart(live, first));
    }
}

}  // namespace

void follow_drift(const DriftSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const Scene scene = read_gltf(settings.shared.scene);
    if (settings.moves % 2 != 0)
        throw Error(ErrorKind::input, "--moves " + std::to_string(settings.moves),
                    "must be even, so that the box comes back");
    report.say(fmt::format("{} at {}², {}", settings.shared.scene, settings.shared.size,
                           words_of(device)));
    report.table("drift",
                 fmt::format("What {} moves leave ([Hoef13] section 4.5.2); at rest, relative to "
                             "the solution before them",
                             settings.moves),
                 {"redistribution", "after", "RMSE %", "residual"}, kSolvedAnew);
    follow(device, scene, Redistribution::incremental, settings, report);
    follow(device, scene, Redistribution::cross, settings, report);
    device.check_validation();
}

}  // namespace lumel::bench
