#include "jobs/solve/setting.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "atlas/near/buried.h"
#include "atlas/prepare/lit_sides.h"
#include "base/core/error.h"
#include "base/core/fingerprint.h"
#include "base/core/log.h"
#include "base/ranks/ranks.h"
#include "jobs/solve/checkpoint.h"
#include "jobs/solve/memory_plan.h"
#include "methods/methods.h"
#include "solve/solver/solver.h"

namespace lumel {
namespace {

/// Time limit that is exceeded already [s].
constexpr double kMinSeconds = 1e-9;

/// Progress of a solve towards the nearest limit, 0…1.
double solved_fraction(const SolverOptions& limits, const SolverState& state, double seconds)
{
    double fraction = 0.0;
    if (limits.max_shots > 0)
        fraction = std::max(fraction, double(state.shots) / double(limits.max_shots));
    if (limits.max_seconds > 0.0)
        fraction = std::max(fraction, seconds / limits.max_seconds);
    // For the progress bar only: assumed decrease of the error with shots, between random and
    // ideal.
    constexpr double kSlope = 0.65;
    // Progress at the first error estimate.
    constexpr double kFirstEstimate = 0.25;
    double error = 1.0;
    if (limits.target_error > 0.0 && state.error > 0.0)
        error = std::min(error, limits.target_error / state.error);
    if (limits.target_dark_error > 0.0 && state.dark_error > 0.0)
        error = std::min(error, limits.target_dark_error / state.dark_error);
    const Quality& quality = limits.target_quality;
    if (quality.eye_error > 0.0 && state.eye_error > 0.0)
        error = std::min(error, quality.eye_error / state.eye_error);
    if (quality.visible_noise > 0.0 && state.visible_noise.worst_chart > 0.0)
        error = std::min(error, quality.visible_noise / state.visible_noise.worst_chart);
    if (error < 1.0)
        fraction = std::max(fraction, std::pow(error, 1.0 / kSlope));
    return std::min(std::max(fraction, kFirstEstimate * state.begun), 1.0);
}

Scene in_stage(Scene scene, Stages& stages)
{
    stages.begin("charts");
    return scene;
}

/// Throws Error{input} unless all ranks have the same lumels.
void agree_on_lumels(Ranks& ranks, const Scene& scene, const Lumels& lumels)
{
    Fingerprint hash;
    hash.add_bytes(scene.hash.data(), scene.hash.size());
    ranks.agree(hash.value(), "has read another scene than rank 0");
    hash.add_bytes(lumels.lumels.data(), lumels.lumels.size() * sizeof(Lumel));
    hash.add_bytes(lumels.pieces.data(), lumels.pieces.size() * sizeof(Piece));
    ranks.agree(hash.value(),
                "has other lumels than rank 0; all machines need processors of the same kind");
}

/// Buries lumels by all ranks; empty for a process of its own.
SolveScene::Bury bury_by(Ranks* ranks)
{
    if (!ranks)
        return {};
    return [ranks](const Scene& scene, const RayScene& rays, const Atlas& atlas, Lumels& lumels,
                   const ProgressCallback& progress) {
        agree_on_lumels(*ranks, scene, lumels);
        return mark_buried(scene, rays, atlas, lumels, {}, progress, ranks);
    };
}

NearField near_field_of(const SolveScene& prepared, const gpu::Device* device,
                        const BakeOptions& given, Stages& stages)
{
    const SolverOptions& options = given.solver;
    tell_user(prepared);
    note_sizes(prepared, stages);
    check_memory(prepared, given, memory_limits(given, device));
    if (!has_near_field(options.method))
        return {};
    stages.begin("near field");
    NearField near = near_field_for(prepared.scene, prepared.rays, prepared.lumels, options);
    stages.note(fmt::format(
        "{} close pairs take {}", near.column.size(),
        memory_text(near.column.size() * (sizeof(near.column[0]) + sizeof(near.factor[0])))));
    return near;
}

std::optional<World> world_on(const gpu::Device* device, const SolveScene& prepared,
                              const BakeOptions& options, Stages& stages)
{
    if (device)
        stages.watch(*device);
    if (!needs_world(options))
        return {};
    stages.begin("uploading");
    return std::optional<World>(std::in_place, *device, prepared.scene, prepared.lumels,
                                &prepared.atlas);
}

/// Notes error estimates, each after twice the shooters of the previous one.
class ErrorNotes {
public:
    explicit ErrorNotes(const SolverOptions& options) : shots_(method_of(options.method).shots) {}

    void add(const SolverState& state, Stages& stages)
    {
        if (state.error < 0.0 || state.shots < next_)
            return;
        std::string note = fmt::format("{} {}, estimated error {:.3f} %", state.shots, shots_,
                                       100.0 * state.error);
        if (state.dark_error >= 0.0)
            note += fmt::format(", of dark lumels {:.2f} %", 100.0 * state.dark_error);
        if (state.eye_error >= 0.0)
            note += fmt::format(", relative to the light around {:.2f} %", 100.0 * state.eye_error);
        if (state.visible_noise.worst_chart >= 0.0)
            note +=
                fmt::format(", visible noise {:.2f} %", 100.0 * state.visible_noise.worst_chart);
        stages.note(note);
        next_ = 2 * state.shots;
    }

private:
    const char* shots_;
    std::uint64_t next_ = 0;
};

/// Whether a rank goes on after a step, and whether it is time for a checkpoint.
struct Wish {
    double seconds;  ///< of solving so far
    bool wants_more, wants_checkpoint;
};

/// The decision of all ranks. Time is that of rank 0; any rank can stop all.
Wish of_all(Ranks* ranks, const Wish& own)
{
    if (!ranks)
        return own;
    const std::vector<Wish> wishes = ranks->all(own);
    Wish common = wishes.front();
    common.wants_more = std::ranges::all_of(wishes, &Wish::wants_more);
    return common;
}

}  // namespace

bool needs_world(const BakeOptions& options)
{
    return method_of(options.solver.method).on_device || options.directional != Directional::none ||
           !options.dump.empty();
}

std::optional<LobeParticles> particles_for(const SolveScene& prepared, const SolverOptions& options)
{
    std::optional<LobeParticles> particles;
    if (method_of(options.method).materials == MaterialModel::glossy && !is_papers(options.method))
        particles.emplace(prepared);
    return particles;
}

Setting::Setting(Scene scene, const gpu::Device* device, const BakeOptions& options, Stages& stages,
                 Ranks* ranks)
    : Setting(
          std::move(scene),
          [&](const Scene& placed, const RayScene& rays, const ProgressCallback& progress) {
              return make_atlas(placed, options.atlas, progress,
                                sides_by_light(options.atlas.sides, rays, options.atlas.daylit));
          },
          device, options, stages, ranks)
{
}

Setting::Setting(Scene scene, const SolveScene::LayOut& lay_out, const gpu::Device* device,
                 const BakeOptions& options, Stages& stages, Ranks* ranks)
    : prepared(in_stage(std::move(scene), stages), lay_out, bury_by(ranks), stages.callback()),
      near(near_field_of(prepared, device, options, stages)),
      world(world_on(device, prepared, options, stages)),
      particles(particles_for(prepared, options.solver))
{
}

SolverOptions for_what_is_left(SolverOptions options, const Stages& stages)
{
    if (options.max_seconds > 0.0)
        options.max_seconds = std::max(options.max_seconds - stages.seconds(), kMinSeconds);
    return options;
}

void tell_missed(const SolverOptions& options, const SolverState& state, Stages& stages)
{
    if (state.shots == 0 || options.has_default_limits() ||
        (options.max_shots == 0 && options.max_seconds <= 0.0))
        return;
    const auto tell = [&](double reached, double wanted, const char* what) {
        if (wanted <= 0.0 || (reached >= 0.0 && reached <= wanted))
            return;
        stages.warn(reached >= 0.0
                        ? fmt::format("the estimated {} is {}, not the {:g} % asked for: "
                                      "the limit of shots or time was reached first",
                                      what, percent_text(reached), 100.0 * wanted)
                        : fmt::format("the limit of shots or time was reached before the {} "
                                      "could be estimated; {:g} % was asked for",
                                      what, 100.0 * wanted));
    };
    tell(state.error, options.target_error, "error");
    tell(state.dark_error, options.target_dark_error, "error of dark lumels");
    tell(state.eye_error, options.target_quality.eye_error, "error relative to the light around");
    tell(state.seen_noise(), options.target_quality.visible_noise, "visible noise");
}

void tell_late(const SolverOptions& options, double before_solving, double first_light,
               Stages& stages)
{
    if (options.max_seconds <= 0.0 || first_light <= options.max_seconds)
        return;
    stages.warn(fmt::format(
        "the time limit of {:g} s was too short: all lumels had their first light after "
        "{:.1f} s, {:.1f} s of them before solving began; the result has the fewest {} possible",
        options.max_seconds, first_light, before_solving, method_of(options.method).shots));
}

SolveRun solve_in_stage(Solver& solver, const SolverOptions& given, Stages& stages,
                        Checkpoint* checkpoint, Ranks* ranks)
{
    SolverOptions options = for_what_is_left(given, stages);
    if (ranks)
        options.max_seconds = ranks->all(options.max_seconds).front();
    const double before_solving = stages.seconds();
    stages.begin("solving");
    stages.note_arrays();
    Checkpoint::Run so_far;
    if (checkpoint)
        so_far = checkpoint->take_up(solver);
    const double before = so_far.seconds;
    SolverOptions limits = options;
    if (limits.max_seconds > 0.0)
        limits.max_seconds = std::max(limits.max_seconds - before, kMinSeconds);
    ErrorNotes errors(options);
    SolveRun run;
    std::optional<double> first_light;  // [s] from the first stage on
    double seconds = 0.0;               // that count for the time limit
    const auto go_on = [&](const SolverState& state) {
        if (state.shots > 0 && !first_light)
            first_light = stages.seconds();
        errors.add(state, stages);
        so_far.seconds = before + stages.stage_seconds();
        std::vector<ConvergencePoint>& curve = so_far.curve;
        if (state.error >= 0.0 && (curve.empty() || curve.back().error != state.error))
            curve.push_back({state.shots, so_far.seconds, state.error});
        const bool wants_more = stages.progress(solved_fraction(options, state, so_far.seconds),
                                                state.shots, state.error);
        const Wish wish = of_all(
            ranks, {stages.stage_seconds(), wants_more, checkpoint && checkpoint->is_due(so_far)});
        seconds = wish.seconds;
        if (!wish.wants_more)
            stages.stop();
        if (wish.wants_checkpoint)
            checkpoint->write(solver, so_far);
        return wish.wants_more;
    };
    run.finished = solve(solver, limits, go_on, [&] { return seconds; });
    const bool kept = !run.finished && checkpoint && checkpoint->stop(solver, so_far);
    run.curve = std::move(so_far.curve);
    if (const SolverState state = solver.state(); !run.finished && state.shots == 0)
        throw Error(ErrorKind::stopped, "",
                    fmt::format("stopped before the first result{}; nothing is written{}",
                                state.begun > 0.0
                                    ? fmt::format(", with {:.0f} % of the first light of "
                                                  "all lumels",
                                                  100.0 * state.begun)
                                    : "",
                                kept ? " but the checkpoint" : ""));
    if (run.finished && first_light)
        tell_late(given, before_solving, *first_light, stages);
    if (solver.state().full)
        stages.warn(
            fmt::format("no memory for more rays: the solve ends at an estimated error of {}; "
                        "raise --max-memory, or use a smaller --size",
                        percent_text(solver.state().error)));
    else if (run.finished)
        tell_missed(options, solver.state(), stages);
    stages.note(fmt::format("{} {} in {} steps", solver.state().shots,
                            method_of(options.method).shots, solver.state().iterations));
    stages.note_times(solver.times());
    return run;
}

void tell_warnings(const Scene& scene)
{
    for (const std::string& warning : scene.warnings)
        log_warning(warning);
}

void note_sizes(const SolveScene& prepared, Stages& stages)
{
    const std::vector<Lumel>& lumels = prepared.lumels.lumels;
    const auto buried = std::count_if(lumels.begin(), lumels.end(), [](const Lumel& lumel) {
        return (lumel.flags & kLumelBuried) != 0;
    });
    stages.note(fmt::format("{} charts on {} x {} texels; {} lumels of {} pieces, {} buried",
                            prepared.atlas.chart_count, prepared.atlas.width, prepared.atlas.height,
                            lumels.size(), prepared.lumels.pieces.size(), buried));
}

void tell_user(const SolveScene& prepared)
{
    tell_warnings(prepared.scene);
    for (const std::string& note : prepared.atlas.notes)
        log_info(note);
}

}  // namespace lumel
