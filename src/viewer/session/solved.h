#pragma once
// The scene as it stands, lit by another method than the links that are kept.

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "jobs/solve/bake_options.h"

namespace lumel {

class ViewSession;

/// A scene as it stands, and its atlas, both without what is deleted.
struct StandingScene {
    Scene scene;
    Atlas atlas;
};

/// Light at the lumels of a session, by a method of methods/methods.h.
struct SolvedLight {
    SolverOptions options;
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]; 0 of what is deleted
    /// [N] Lies under or in something, where things stand now. What may move buries nothing of the
    /// session's own light.
    std::vector<char> buried;
    std::uint64_t shots = 0;
    double error = -1.0;   ///< that the method states, as a part of the mean; < 0: it states none
    double seconds = 0.0;  ///< that it took, in all
    bool stopped = false;  ///< before its end
    std::vector<std::string> warnings;
};

/// Solves by the pipeline of lumel bake. lumels: of the session. Throws Error.
SolvedLight solve_standing(const gpu::Device& device, StandingScene standing, const Lumels& lumels,
                           const SolverOptions& options, const ProgressFunction& progress = {});

/// The same on a thread of its own, by a device of its own, while the session goes on. It lights
/// the scene as it stood in the beginning.
class SolveAside {
public:
    /// The session must outlive it. Throws Error.
    SolveAside(const ViewSession& session, const SolverOptions& options);
    /// Stops it.
    ~SolveAside();
    SolveAside(const SolveAside&) = delete;
    SolveAside& operator=(const SolveAside&) = delete;

    /// Waits for so long, or until it has ended.
    bool has_ended(std::chrono::milliseconds wait) const;
    BakeProgress progress() const;
    const SolverOptions& options() const { return options_; }
    /// Ends with the light that there is then, if there is any.
    void stop() { stop_ = true; }
    /// Waits for the end. Throws Error of what could not be solved, once.
    SolvedLight take();
    /// ViewSession::edits() when it began.
    std::uint64_t edits() const { return edits_; }

private:
    SolverOptions options_;
    std::uint64_t edits_;
    gpu::Device device_;
    std::atomic<bool> stop_ = false;
    mutable std::mutex mutex_;
    BakeProgress now_;
    std::future<SolvedLight> light_;
};

}  // namespace lumel
