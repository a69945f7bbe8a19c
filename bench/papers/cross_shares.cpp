// How far `cross` is from a solution from scratch after a move, and what brings it nearer: the
// shares of lamp points, of visibility, and of light left unshot.

#include <limits>

#include <fmt/format.h>

#include "bench/papers/dynamic_stage.h"
#include "bench/papers/figures.h"

namespace lumel::bench {
namespace {

constexpr int kFiner = 4;           ///< as wide are hemicubes
constexpr std::uint32_t kMore = 8;  ///< as many are shooters
constexpr double kLessLeft = 0.1;   ///< of the residual

/// The last move, and its processor time.
struct TimedMove {
    BeforeAndAfter light;
    double cpu_ms = 0.0;
};

TimedMove solved_anew(const gpu::Device& device, const Stage& stage)
{
    TimedMove solved;
    const auto at = [&](const glm::mat4& place) {
        LiveScene live(device, stage.scene, stage.options);
        solved.cpu_ms = update_after_move(live, stage.box, place).whole_cpu_ms;
        return live.irradiance();
    };
    solved.light.before = at(stage.places.end()[-2]);
    solved.light.after = at(stage.places.back());
    return solved;
}

TimedMove followed(const gpu::Device& device, const Stage& stage, Redistribution redistribution)
{
    LiveOptions options = stage.options;
    options.redistribution = redistribution;
    LiveScene live(device, stage.scene, options);
    live.settle();
    TimedMove solved;
    for (const glm::mat4& place : stage.places) {
        solved.light.before = live.irradiance();
        solved.cpu_ms = update_after_move(live, stage.box, place).whole_cpu_ms;
    }
    solved.light.after = live.irradiance();
    return solved;
}

TimedMove by_cross(const gpu::Device& device, const Stage& stage)
{
    return followed(device, stage, Redistribution::cross);
}

void measure(const gpu::Device& device, const std::string& scene, const Stage& stage,
             Report& report)
{
    const LiveScene laid_out(device, stage.scene, stage.options);
    const auto add_row = [&](const char* what, const TimedMove& found, const TimedMove& wanted) {
        const ShareOfMove share = share_of_move(laid_out.lumels(), found.light, wanted.light);
        report.row({scene, what, fixed(100.0 * share.change, 3),
                    fixed(100.0 * share.left * share.change, 3), fixed(100.0 * share.left, 0),
                    fixed(100.0 * share.missed, 0), fixed(found.cpu_ms, 0)});
    };
    const TimedMove scratch = solved_anew(device, stage);
    const auto add = [&](const char* what, const auto& change_options, bool of_both) {
        Stage changed = stage;
        change_options(changed.options);
        add_row(what, by_cross(device, changed), of_both ? solved_anew(device, changed) : scratch);
    };
    add(
        "cross", [](LiveOptions&) {}, false);
    Stage own = stage;
    own.options.redistribution = Redistribution::cross;
    add_row("cross, against cross from scratch", by_cross(device, stage), solved_anew(device, own));
    Stage other = stage;
    ++other.options.solver.seed;
    add_row("progressive, lumels receive at other points", solved_anew(device, other), scratch);
    add(
        "lamps shoot from the solution's points",
        [](LiveOptions& options) {
            options.cross.lamp_points = std::numeric_limits<std::uint32_t>::max();
        },
        false);
    add(
        "a tenth of the residual, both",
        [](LiveOptions& options) { options.residual *= kLessLeft; }, true);
    add(
        "hemicubes four times as wide, both",
        [](LiveOptions& options) { options.solver.views.hemicube *= kFiner; }, true);
    add(
        "eight times the shooters, both",
        [](LiveOptions& options) { options.solver.shooters *= kMore; }, true);
    Stage finer = stage;
    finer.options.solver.views.hemicube *= kFiner;
    finer.options.solver.shooters *= kMore;
    const TimedMove fine = solved_anew(device, finer);
    add_row("cross, against progressive with both", by_cross(device, stage), fine);
    add_row("progressive, against progressive with both", scratch, fine);
    add_row("incremental, against progressive with both",
            followed(device, stage, Redistribution::incremental), fine);
    other = finer;
    ++other.options.solver.seed;
    add_row("progressive with both, lumels receive at other points", solved_anew(device, other),
            fine);
    finer.options.cross.lamp_points = std::numeric_limits<std::uint32_t>::max();
    add_row("cross with both and all lamp points, against progressive with both",
            by_cross(device, finer), fine);
}

}  // namespace

void share_out_cross(const DynamicSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    report.say(fmt::format("hemicubes of side {}, {}",
                           options_of<ProgressiveOptions>(settings.shared).views.hemicube,
                           words_of(device)));
    report.table("shares",
                 "Distance of cross from a solution from scratch after a move, relative RMSE, and "
                 "what brings it nearer",
                 {"scene", "what", "change by the move, %", "distance, %", "of the change, %",
                  "missed of the change, %", "cpu ms of the move"},
                 kSolvedAnew);
    for (const ThesisScene& scene : scenes_of(settings))
        measure(device, scene.title, set(scene, settings, 1), report);
    device.check_validation();
}

}  // namespace lumel::bench
