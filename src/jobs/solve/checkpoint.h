#pragma once
// The state of an unfinished bake on the disk, from which it can go on.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas/prepare/prepare.h"
#include "jobs/solve/bake_options.h"
#include "results/record/report.h"
#include "solve/solver/solver.h"

namespace lumel {

/// In the folder of the results, while these are not there.
inline constexpr const char* kCheckpointFile = ".lumel-checkpoint";

/// Throws Error{input} if --resume is asked for with a method that cannot go on.
void check_resume(const BakeOptions& options);

/// Writes the state of a solve now and then, and reads it back. It is written in one step, and does
/// not fit another scene, other options or another version of Lumel.
class Checkpoint {
public:
    /// Beside the solver's own state.
    struct Run {
        double seconds = 0.0;  ///< of solving so far
        std::vector<ConvergencePoint> curve;
    };

    Checkpoint(const std::string& folder, const BakeOptions& options, const Prepared& prepared);

    /// With --resume: takes up what is there, and returns how far that had come. Throws
    /// Error{input} if it is of other work or damaged.
    Run take_up(Solver& solver);
    /// Writes it if it is time. What cannot be written is a warning, and the former one stays.
    /// Without --resume it takes the place of another bake's once this one has solved for longer.
    void keep(Solver& solver, const Run& run);
    /// For a solve that the user has stopped: kept with --resume. Without, it is removed, unless
    /// there was one before this bake.
    void stop(Solver& solver, const Run& run);

private:
    /// What a state belongs to.
    struct Origin {
        std::string version, scene, options, rays;
        bool operator==(const Origin&) const = default;
        template <class Archive>
        void state(Archive& archive)
        {
            archive(version, scene, options, rays);
        }
    };

    double seconds_of_older(std::uint64_t size) const;
    void write(Solver& solver, const Run& run);

    std::string path_;
    bool can_, resume_;
    const char* unit_;  ///< of shots
    double every_;      ///< [s], 0: never
    Origin origin_;
    double next_ = 0.0;            ///< [s] of wall_seconds()
    std::optional<double> older_;  ///< [s] of solving in one that this bake does not go on from
    bool warned_ = false;
};

}  // namespace lumel
