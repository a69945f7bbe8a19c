// Radiosity by a matrix of all reflections, with separate sources.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017.
//
// As methods/matrix/matrix.cpp, but with separate direct light of each source: emissive surfaces by
// rays to them alone, sky and lamps as given.

#include "methods/matrix/relight_solver.h"

#include <algorithm>
#include <cmath>

#include "base/core/usage.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Error of the stored matrix's indirect light: far below that of form factors, at a tenth of their
/// bytes.
constexpr float kTileError = 0.002f;

/// Mean over lumels and channels [lx].
double mean_of(std::span<const glm::vec3> irradiance)
{
    return irradiance_sum(irradiance) / (3.0 * double(std::max<std::size_t>(irradiance.size(), 1)));
}

}  // namespace

RelightSolver::Emitter::Emitter(const LightSource& source, const RelightSolver& of)
    : solver(*of.scene_, of.matrix_.seed, of.limits_.target_error, {}, source.instances),
      start(wall_seconds())
{
}

RelightSolver::RelightSolver(const gpu::Device& device, const World& world, const SolveScene& scene,
                             const NearField& near, const MatrixOptions& options,
                             const SolveLimits& limits, std::vector<KnownSource> sources,
                             Parts parts)
    : scene_(&scene),
      parts_(parts),
      limits_(limits),
      matrix_(options),
      start_(wall_seconds()),
      sources_(std::move(sources)),
      surfaces_(sources_.size()),
      reflected_(sources_.size())
{
    const Lumels& lumels = scene.lumels;
    for (KnownSource& source : sources_)
        source.direct.resize(lumels.lumels.size(), glm::vec3(0.0f));
    if (parts != Parts::direct && reflecting_area(lumels) > 0.0f)
        builder_.emplace(device, world, lumels, near, matrix_.transport);
    else
        begin_source();
}

std::uint64_t RelightSolver::device_bytes(const SolveSize& size, const MatrixOptions& options)
{
    return FormFactors::device_bytes(size, options.transport.views);
}

void RelightSolver::step()
{
    if (builder_) {
        builder_->step();
        if (builder_->done())
            finish_builder();
        return;
    }
    if (!emitter_)
        return;
    if (emitter_->last) {
        emitter_->last->step();
        if (emitter_->last->done())
            end_source();
        return;
    }
    emitter_->solver.step();
    if (is_enough())
        end_direct();
}

void RelightSolver::finish_builder()
{
    transport_ = builder_->finish();
    add_times(builder_->factors().times());
    longest_ = std::max(longest_, builder_->factors().longest_submission());
    builder_.reset();
    begin_source();
}

/// Starts the next source that has surfaces, if any.
void RelightSolver::begin_source()
{
    emitter_.reset();
    while (next_ < sources_.size() && sources_[next_].source.instances.empty())
        ++next_;
    if (next_ == sources_.size())
        return;
    emitter_.emplace(sources_[next_].source, *this);
    const double left = limits_.max_seconds - (emitter_->start - start_);
    emitter_->seconds = std::max(left, 0.0) / double(emitters_from(next_));
}

/// Number of sources with surfaces, from this one on.
std::size_t RelightSolver::emitters_from(std::size_t first) const
{
    return std::size_t(
        std::count_if(sources_.begin() + std::ptrdiff_t(first), sources_.end(),
                      [](const KnownSource& known) { return !known.source.instances.empty(); }));
}

bool RelightSolver::is_enough() const
{
    const SolverState state = emitter_->solver.state();
    const std::uint64_t emitters = emitters_from(0);
    const std::uint64_t shots = (limits_.max_shots + emitters - 1) / emitters;
    return (limits_.max_shots > 0 && state.shots >= shots) ||
           (limits_.max_seconds > 0.0 && state.shots > 0 &&
            wall_seconds() - emitter_->start >= emitter_->seconds) ||
           (limits_.target_error > 0.0 && state.error >= 0.0 &&
            state.error <= limits_.target_error) ||
           state.full;
}

/// Continues with the reflections of the surfaces' light.
void RelightSolver::end_direct()
{
    const SolverState state = emitter_->solver.state();
    surfaces_[next_] = emitter_->solver.irradiance();
    shots_ += state.shots;
    iterations_ += state.iterations;
    const double error = std::max(state.error, 0.0) * mean_of(surfaces_[next_]);
    square_error_ += error * error;
    if (!transport_) {
        end_source();
        return;
    }
    emitter_->last.emplace(emitter_->solver, transport_->indirect(scene_->lumels, surfaces_[next_]),
                           gather_rays(limits_.target_error), matrix_.seed);
}

void RelightSolver::end_source()
{
    if (emitter_->last)
        reflected_[next_] = emitter_->last->irradiance();
    ++next_;
    begin_source();
}

void RelightSolver::add_times(const gpu::StageTimes& times)
{
    for (const auto& [stage, ms] : times)
        times_[stage] += ms;
}

double RelightSolver::fraction() const
{
    const double parts = double(sources_.size()) + 1.0;  // the matrix counts as one
    return (builder_ ? builder_->fraction() : 1.0 + double(next_)) / parts;
}

SolverState RelightSolver::state() const
{
    SolverState state{.shots = shots_, .iterations = iterations_};
    if (emitter_ && !emitter_->last) {
        state.shots += emitter_->solver.state().shots;
        state.iterations += emitter_->solver.state().iterations;
    } else if (done() && iterations_ > 0) {
        double mean = 0.0;
        for (std::size_t s = 0; s < sources_.size(); ++s)
            mean += mean_of(sources_[s].direct) + mean_of(surfaces_[s]);
        state.error = mean > 0.0 ? std::sqrt(square_error_) / mean : 0.0;
    }
    return state;
}

std::vector<glm::vec3> RelightSolver::irradiance()
{
    const std::size_t count = scene_->lumels.lumels.size();
    // Light whose last bounce is by patches, and reflected light by rays.
    std::vector<glm::vec3> direct(count, glm::vec3(0.0f)), by_patches = direct, reflected = direct;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        add_light(direct, sources_[s].direct);
        add_light(direct, surfaces_[s]);
        add_light(by_patches, sources_[s].direct);
        add_light(reflected_[s].empty() ? by_patches : reflected,
                  reflected_[s].empty() ? surfaces_[s] : reflected_[s]);
    }
    if (emitter_ && !emitter_->last) {
        add_light(direct, emitter_->solver.irradiance());
        add_light(by_patches, emitter_->solver.irradiance());
    }
    if (transport_)
        add_light(reflected, transport_->indirect(scene_->lumels, by_patches));
    if (parts_ == Parts::indirect)
        return reflected;
    add_light(direct, reflected);
    return direct;
}

Relightable RelightSolver::relightable(const std::string& hash) const
{
    Relightable light{.scene_hash = hash, .side = std::uint32_t(scene_->lumels.width)};
    for (const Lumel& lumel : scene_->lumels.lumels) {
        light.place.push_back(place_of(lumel.texel, (lumel.flags & kLumelBack) != 0));
        light.area.push_back((lumel.flags & kLumelBuried) ? 0.0f : lumel.area);
        light.albedo.push_back(lumel.albedo);
    }
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        const KnownSource& known = sources_[s];
        SourceLight& source = light.sources.emplace_back(
            SourceLight{known.source.name, known.source.materials, known.direct, reflected_[s]});
        if (transport_ && !source.reflected.empty())
            add_light(source.reflected, transport_->indirect(scene_->lumels, known.direct));
        add_light(source.direct, surfaces_[s]);
        source.lights = lamps_of(scene_->scene, known.source).lights;
    }
    light.profiles = scene_->scene.profiles;
    light.origin = scene_->scene.origin;
    if (transport_) {
        light.patches = transport_->patches;
        light.rows = transport_->rows;
        if (matrix_.form == MatrixForm::bc1)
            light.matrix = compress_bc1(transport_->bounces, {});
        else
            light.matrix = compress_tiles(transport_->bounces, elements_of(light.patches),
                                          {.error = kTileError});
    }
    return light;
}

}  // namespace lumel
