#pragma once
// The current scene, lit by a method other than links.

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "jobs/solve/bake_options.h"
#include "links/live/baked_light.h"

namespace lumel {

class ViewSession;

/// Light at the lumels of a session, by a method of methods/methods.h.
struct SolvedLight {
    SolverOptions options;
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]; 0 for deleted objects
    /// [N] 1: under or inside an object at its current position. In the session's own light,
    /// movable objects bury nothing.
    std::vector<char> buried;
    std::uint64_t shots = 0;
    double error = -1.0;   ///< relative, estimated by the method; < 0: unknown
    double seconds = 0.0;  ///< total
    bool stopped = false;  ///< by the user
    std::vector<std::string> warnings;
};

/// Solves by the pipeline of lumel bake. lumels: of the session. Throws Error.
SolvedLight solve_standing(const gpu::Device& device, StandingScene standing, const Lumels& lumels,
                           const SolverOptions& options, const ProgressFunction& progress = {});

/// Solves in a separate thread with its own device, while the session continues. Lights the scene
/// as it was at the start.
class SolveAside {
public:
    /// The session must outlive this. Throws Error.
    SolveAside(const ViewSession& session, const SolverOptions& options);
    /// Stops the solve.
    ~SolveAside();
    SolveAside(const SolveAside&) = delete;
    SolveAside& operator=(const SolveAside&) = delete;

    /// Waits for at most `wait`. Returns true if the solve has ended.
    bool has_ended(std::chrono::milliseconds wait) const;
    BakeProgress progress() const;
    const SolverOptions& options() const { return options_; }
    /// Ends the solve with its current light, if there is any.
    void stop() { stop_ = true; }
    /// Waits for the end. Throws the solve's Error, once.
    SolvedLight take();
    /// ViewSession::edits() at the start.
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
