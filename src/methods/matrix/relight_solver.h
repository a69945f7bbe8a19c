#pragma once
// A solution that keeps the light of every source apart. See relight_solver.cpp.

#include <optional>
#include <vector>

#include "lights/light_sources.h"
#include "methods/matrix/matrix.h"
#include "methods/matrix/relightable.h"
#include "solve/solver/solve_limits.h"

namespace lumel {

/// A source with what its lamps and sky send straight to the lumels.
struct KnownSource {
    LightSource source;
    std::vector<glm::vec3> direct;  ///< [N] lx, or empty: none
};

/// Finds a Transport, then the direct light of each source's surfaces, one after the other. Ends by
/// itself: the options' error holds for each of these sources, their shots and time are shared.
class RelightSolver final : public Solver {
public:
    /// All but the sources must outlive this. parts: of the light
    /// that irradiance() has.
    RelightSolver(const gpu::Device& device, const World& world, const HostScene& host,
                  const Lumels& lumels, const NearField& near, const MatrixOptions& options,
                  const SolveLimits& limits, std::vector<KnownSource> sources, Parts parts);

    /// Bytes on the device at most, on one whose images may be as large as is wanted.
    static std::uint64_t device_bytes(const SolveSize& size, const MatrixOptions& options);

    void step() override;
    bool done() const { return !builder_ && next_ == sources_.size(); }
    double fraction() const;  ///< of the work, roughly, 0…1

    /// The error is that of direct light, once all of it is found.
    SolverState state() const override;
    /// What is missing before done() is left out.
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override { return longest_; }
    std::string rays() const override { return "host"; }

    /// Null until the form factors are found, or if nothing reflects.
    const Transport* transport() const { return transport_ ? &*transport_ : nullptr; }

    /// Once done. hash: Scene::hash.
    Relightable relightable(const std::string& hash) const;

private:
    /// The source at work.
    struct Emitter {
        Emitter(Scene only_shining, const RelightSolver& of);

        Scene scene;  ///< in which only the source's surfaces shine
        HostScene host;
        DirectRays solver;
        std::optional<FinalGather> last;  ///< once direct light is found
        double start, seconds;  ///< when it began and what it may take, if there is a limit [s]
    };

    void begin_source();
    std::size_t emitters_from(std::size_t first) const;
    bool is_enough() const;
    void end_direct();
    void end_source();
    void finish_builder();
    void add_times(const gpu::StageTimes& times);

    HostScene host_;
    const Lumels* lumels_;
    Parts parts_;
    SolveLimits limits_;
    MatrixOptions matrix_;
    double start_;
    std::optional<TransportBuilder> builder_;
    std::optional<Transport> transport_;
    std::vector<KnownSource> sources_;
    std::vector<std::vector<glm::vec3>> surfaces_, reflected_;  ///< [sources][N], or empty
    std::size_t next_ = 0;  ///< source whose surfaces are at work
    std::optional<Emitter> emitter_;
    std::uint64_t shots_ = 0, iterations_ = 0;  ///< of sources that are done
    double square_error_ = 0.0;                 ///< Σ (error × mean H)² of these [lx²]
    gpu::StageTimes times_;
    double longest_ = 0.0;
};

}  // namespace lumel
