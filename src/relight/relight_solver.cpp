// Radiosity by a matrix of all reflections, its sources apart.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017.
//
// As solve/matrix.cpp, but with the direct light of each source by itself: surfaces that shine by
// stochastic radiosity in a black scene where no others do, sky and lamps as given.

#include "relight/relight_solver.h"

#include <algorithm>
#include <cmath>

#include "core/usage.h"
#include "shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Of indirect light from the stored matrix: far below that of form factors, and still a tenth of
/// their bytes.
constexpr float kTileError = 0.002f;

/// Mean over lumels and channels [lx].
double mean_of(std::span<const glm::vec3> irradiance)
{
    return irradiance_sum(irradiance) / (3.0 * double(std::max<std::size_t>(irradiance.size(), 1)));
}

}  // namespace

RelightSolver::RelightSolver(const gpu::Device& device, const World& world, const Lumels& lumels,
                             const NearField& near, const SolverOptions& options,
                             std::vector<KnownSource> sources)
    : device_(&device),
      world_(&world),
      lumels_(&lumels),
      near_(&near),
      options_(options),
      matrix_(std::get<MatrixOptions>(options.method)),
      start_(wall_seconds()),
      sources_(std::move(sources))
{
    for (KnownSource& source : sources_)
        source.direct.resize(lumels.lumels.size(), glm::vec3(0.0f));
    if (reflecting_area(lumels) > 0.0f)
        builder_.emplace(device, world, lumels, near, matrix_.transport);
    else
        begin_source();
}

std::uint64_t RelightSolver::device_bytes(const SolveSize& size, const MatrixOptions& options)
{
    // One after the other.
    return std::max(FormFactors::device_bytes(size, options.transport.views),
                    StochasticRadiosity::device_bytes(size, direct_options(options)));
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
    emitter_->solver->step();
    if (is_enough())
        end_source();
}

void RelightSolver::finish_builder()
{
    transport_ = builder_->finish();
    add_times(builder_->factors().times());
    longest_ = std::max(longest_, builder_->factors().longest_submission());
    builder_.reset();
    begin_source();
}

/// The next source that has surfaces; none if all are done.
void RelightSolver::begin_source()
{
    emitter_.reset();
    while (next_ < sources_.size() && sources_[next_].source.instances.empty())
        ++next_;
    if (next_ == sources_.size())
        return;
    emitter_.emplace();
    emitter_->lumels = only_shining(black(*lumels_), sources_[next_].source);
    emitter_->solver.emplace(*device_, *world_, emitter_->lumels, *near_, direct_options(matrix_));
    emitter_->start = wall_seconds();
    const double left = options_.max_seconds - (emitter_->start - start_);
    emitter_->seconds = std::max(left, 0.0) / double(emitters_from(next_));
}

/// Sources with surfaces, from this one on.
std::size_t RelightSolver::emitters_from(std::size_t first) const
{
    return std::size_t(
        std::count_if(sources_.begin() + std::ptrdiff_t(first), sources_.end(),
                      [](const KnownSource& known) { return !known.source.instances.empty(); }));
}

bool RelightSolver::is_enough() const
{
    const SolverState state = emitter_->solver->state();
    const std::uint64_t emitters = emitters_from(0);
    const std::uint64_t shots = (options_.max_shots + emitters - 1) / emitters;
    return (options_.max_shots > 0 && state.shots >= shots) ||
           (options_.max_seconds > 0.0 && wall_seconds() - emitter_->start >= emitter_->seconds) ||
           (options_.target_error > 0.0 && state.error >= 0.0 &&
            state.error <= options_.target_error);
}

void RelightSolver::end_source()
{
    const SolverState state = emitter_->solver->state();
    const std::vector<glm::vec3> light = emitter_->solver->irradiance();
    shots_ += state.shots;
    iterations_ += state.iterations;
    const double error = std::max(state.error, 0.0) * mean_of(light);
    square_error_ += error * error;
    add_light(sources_[next_].direct, light);
    add_times(emitter_->solver->times());
    longest_ = std::max(longest_, emitter_->solver->longest_submission());
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
    const double parts = double(sources_.size()) + 1.0;  // the matrix is one
    return (builder_ ? builder_->fraction() : 1.0 + double(next_)) / parts;
}

SolverState RelightSolver::state() const
{
    SolverState state{.shots = shots_, .iterations = iterations_};
    if (emitter_) {
        state.shots += emitter_->solver->state().shots;
        state.iterations += emitter_->solver->state().iterations;
    } else if (done() && iterations_ > 0) {
        double mean = 0.0;
        for (const KnownSource& source : sources_)
            mean += mean_of(source.direct);
        state.error = mean > 0.0 ? std::sqrt(square_error_) / mean : 0.0;
    }
    return state;
}

std::vector<glm::vec3> RelightSolver::irradiance()
{
    std::vector<glm::vec3> light(lumels_->lumels.size(), glm::vec3(0.0f));
    for (const KnownSource& source : sources_)
        add_light(light, source.direct);
    if (emitter_)
        add_light(light, emitter_->solver->irradiance());
    if (transport_)
        add_light(light, transport_->indirect(*lumels_, light));
    return light;
}

Relightable RelightSolver::relightable(const std::string& hash) const
{
    Relightable light{.scene_hash = hash, .side = std::uint32_t(lumels_->width)};
    for (const Lumel& lumel : lumels_->lumels) {
        light.place.push_back(place_of(lumel.texel, (lumel.flags & kLumelBack) != 0));
        light.area.push_back((lumel.flags & kLumelBuried) ? 0.0f : lumel.area);
    }
    for (const KnownSource& known : sources_)
        light.sources.push_back({known.source.name, known.source.materials, known.direct});
    if (transport_) {
        light.patches = transport_->patches;
        light.transfer = transport_->transfer;
        light.matrix =
            compress_tiles(transport_->bounces, elements_of(light.patches), {.error = kTileError});
    }
    return light;
}

}  // namespace lumel
