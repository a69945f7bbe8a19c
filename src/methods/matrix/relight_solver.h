#pragma once
// A solution with separate light of every source. See relight_solver.cpp.

#include <optional>
#include <vector>

#include "lights/light_sources.h"
#include "methods/matrix/matrix.h"
#include "methods/matrix/relightable.h"
#include "solve/solver/solve_limits.h"

namespace lumel {

/// A source with the direct light of its lamps and sky.
struct KnownSource {
    LightSource source;
    std::vector<glm::vec3> direct;  ///< [N] lx, or empty: none
};

/// Computes a Transport, then the direct light of each source's surfaces in turn. Ends by itself:
/// the options' error is for each of these sources; they share shots and time.
class RelightSolver final : public Solver {
public:
    /// All but the sources must outlive this. irradiance() returns `parts` of the light.
    RelightSolver(const gpu::Device& device, const World& world, const SolveScene& scene,
                  const NearField& near, const MatrixOptions& options, const SolveLimits& limits,
                  std::vector<KnownSource> sources, Parts parts);

    /// Upper bound on GPU memory [bytes], if the device does not limit images.
    static std::uint64_t device_bytes(const SolveSize& size, const MatrixOptions& options);

    void step() override;
    bool done() const { return !builder_ && next_ == sources_.size(); }
    double fraction() const;  ///< approximate progress, 0…1

    /// The error is that of direct light, once all of it is known.
    SolverState state() const override;
    /// Before done(), without the light not computed yet.
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override { return longest_; }
    std::string rays() const override { return "host"; }

    /// Null until the form factors are found, or if nothing reflects.
    const Transport* transport() const { return transport_ ? &*transport_ : nullptr; }

    /// Once done. hash: Scene::hash.
    Relightable relightable(const std::string& hash) const;

private:
    /// The current source.
    struct Emitter {
        Emitter(const LightSource& source, const RelightSolver& of);

        DirectRays solver;
        std::optional<FinalGather> last;  ///< once direct light is known
        double start, seconds;            ///< start, and time limit if any [s]
    };

    void begin_source();
    std::size_t emitters_from(std::size_t first) const;
    bool is_enough() const;
    void end_direct();
    void end_source();
    void finish_builder();
    void add_times(const gpu::StageTimes& times);

    const SolveScene* scene_;
    Parts parts_;
    SolveLimits limits_;
    MatrixOptions matrix_;
    double start_;
    std::optional<TransportBuilder> builder_;
    std::optional<Transport> transport_;
    std::vector<KnownSource> sources_;
    std::vector<std::vector<glm::vec3>> surfaces_, reflected_;  ///< [sources][N], or empty
    std::size_t next_ = 0;                                      ///< current source
    std::optional<Emitter> emitter_;
    std::uint64_t shots_ = 0, iterations_ = 0;  ///< totals of finished sources
    double square_error_ = 0.0;                 ///< Σ (error × mean H)² of these [lx²]
    gpu::StageTimes times_;
    double longest_ = 0.0;
};

}  // namespace lumel
