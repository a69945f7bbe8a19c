#include "viewer/session/solved.h"

#include <exception>

#include <fmt/format.h>

#include "atlas/lumels/sides.h"
#include "atlas/near/still_part.h"
#include "base/core/error.h"
#include "base/core/log.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/memory_plan.h"
#include "methods/methods.h"
#include "solve/solver/solver.h"
#include "viewer/session/session.h"

namespace lumel {
/// Rereads materials for methods that support gloss, which links do not. Objects are where they are
/// displayed, even if their light is not there yet.
StandingScene ViewSession::standing(MaterialModel model) const
{
    Scene scene = live_.standing().scene;
    if (model != scene.model) {
        Scene read = read_gltf(shown_.path, model);
        if (read.instances.size() != scene.instances.size() ||
            read.materials.size() != scene.materials.size())
            throw Error(ErrorKind::input, shown_.path, "has changed since it was opened");
        for (std::size_t m = 0; m < read.materials.size(); ++m) {
            read.materials[m].base_color = scene.materials[m].base_color;
            read.materials[m].emitted = scene.materials[m].emitted;
        }
        read.max_albedo = scene.max_albedo;
        read.profiles = std::move(scene.profiles);
        read.lights = std::move(scene.lights);
        read.sky = std::move(scene.sky);
        scene = std::move(read);
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        scene.instances[i].transform = shown_.instances[i].transform;
    std::vector<char> deleted(scene.instances.size(), 0);
    for (const MovableObject& thing : things_)
        for (const std::uint32_t instance : thing.instances)
            deleted[instance] = thing.deleted;
    return {without(scene, deleted), drawn_};
}

SolvedLight solve_standing(const gpu::Device& device, StandingScene standing, const Lumels& lumels,
                           const SolverOptions& solver, const ProgressFunction& progress)
{
    const LogCapture silent;  // the reader's warnings were shown before
    BakeOptions options;
    options.solver = solver;
    Stages stages(progress);
    const Setting setting(
        std::move(standing.scene),
        [&](const Scene&, const RayScene&, const ProgressCallback&) {
            return std::move(standing.atlas);
        },
        &device, options, stages);
    limit_links(options, setting.prepared, memory_limits(options, &device));
    const std::unique_ptr<Solution> solution = solve_light(&device, setting, options, stages);
    stages.end();
    device.check_validation();
    const SolverState state = solution->solver->state();
    const Lumels& solved = setting.prepared.lumels;
    return {.options = solver,
            .irradiance = carried(solution->irradiance, solved, lumels),
            .buried = carried(buried_of(solved), solved, lumels),
            .shots = state.shots,
            .error = state.error,
            .seconds = stages.seconds(),
            .stopped = !solution->run.finished,
            .warnings = stages.warnings()};
}

SolveAside::SolveAside(const ViewSession& session, const SolverOptions& options)
    : options_(options),
      edits_(session.edits()),
      device_(session.options().device)
{
    StandingScene standing = session.standing(method_of(options.method).materials);
    const auto watch = [this](const BakeProgress& now) {
        const std::lock_guard lock(mutex_);
        now_ = now;
        return !stop_;
    };
    light_ = std::async(std::launch::async, [this, watch, standing = std::move(standing),
                                             &lumels = session.light().lumels()]() mutable {
        return solve_standing(device_, std::move(standing), lumels, options_, watch);
    });
}

SolveAside::~SolveAside()
{
    stop();
    if (light_.valid())
        light_.wait();
}

bool SolveAside::has_ended(std::chrono::milliseconds wait) const
{
    return light_.wait_for(wait) == std::future_status::ready;
}

BakeProgress SolveAside::progress() const
{
    const std::lock_guard lock(mutex_);
    return now_;
}

SolvedLight SolveAside::take()
{
    try {
        return light_.get();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::stopped)
            throw;
        throw Error(ErrorKind::stopped, "", "solving was stopped before the first result");
    } catch (const std::exception& error) {  // such as out of memory: the display goes on
        throw Error(ErrorKind::device, "",
                    fmt::format("solving by {} failed: {}; a smaller atlas needs less memory",
                                method_of(options_.method).id, error.what()));
    }
}

}  // namespace lumel
