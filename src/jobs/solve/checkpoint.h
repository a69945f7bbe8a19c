#pragma once
// Checkpoint file of an unfinished bake.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "base/core/error.h"
#include "jobs/solve/bake_options.h"
#include "results/record/report.h"
#include "solve/solver/solver.h"

namespace lumel {

/// In the folder of the results, until these are there.
inline constexpr const char* kCheckpointFile = ".lumel-checkpoint";

/// Throws Error{input} for --resume with a method that cannot continue.
void check_resume(const BakeOptions& options);

/// Writes the state of a solve periodically, and reads it back. Writes are atomic. A checkpoint is
/// valid for the same scene, options and version of Lumel only.
class Checkpoint {
public:
    /// State in addition to the solver's.
    struct Run {
        double seconds = 0.0;  ///< total solving time
        std::vector<ConvergencePoint> curve;
    };

    /// writes: false for ranks that take part in writing, but leave the file to the first.
    Checkpoint(const std::string& folder, const BakeOptions& options, const SolveScene& prepared,
               bool writes = true);

    /// With --resume: loads the checkpoint if there is one, and returns its status. Throws
    /// Error{input} if it is of other work or damaged.
    Run take_up(Solver& solver);
    /// True if it is time to write. Without --resume, a bake replaces another bake's checkpoint
    /// only after solving for longer than that.
    bool is_due(const Run& run) const;
    /// Writes a checkpoint, all ranks together. On failure, warns once, keeps the previous one and
    /// returns false.
    bool write(Solver& solver, const Run& run);
    /// For a solve stopped by the user: keeps the checkpoint with --resume, and returns true if it
    /// is written; otherwise removes it, unless it existed before this bake.
    bool stop(Solver& solver, const Run& run);

private:
    /// Identity of the work.
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
    void warn(const Error& error);

    std::string path_;
    bool can_, resume_, writes_;
    const char* unit_;  ///< name of shots
    double every_;      ///< [s], 0: never
    Origin origin_;
    double next_ = 0.0;            ///< [s] in wall_seconds()
    std::optional<double> older_;  ///< [s] solving time of one that this bake does not continue
    bool warned_ = false;
};

}  // namespace lumel
