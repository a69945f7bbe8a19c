#pragma once
// Light of a live scene at rest, by the solver of `lumel bake`: less noisy than live links, and
// equal to a bake of the edited scene.

#include <chrono>
#include <future>
#include <optional>
#include <stop_token>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "links/trace/links_options.h"

namespace lumel {

/// The current scene and its atlas, both without deleted objects.
struct StandingScene {
    Scene scene;
    Atlas atlas;
};

/// Light at the lumels of a live scene.
struct BakedLight {
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]; 0 for deleted objects
    std::vector<float> error_estimate;  ///< [N] of each lumel, relative to its light, 0…1
    /// [N] 1: under or inside an object at its current position. In live light, movable objects
    /// bury nothing.
    std::vector<char> buried;
    double error = -1.0;  ///< estimated error of all, relative
};

/// Solves on the CPU. own: lumels of the live scene. target_error: above 0; the ray limit that
/// goes with it can end the bake before. Throws Error.
BakedLight bake_standing(StandingScene standing, const Lumels& own, const LinksOptions& options,
                         double target_error, const ProgressCallback& progress = {});

/// bake_standing() in a thread of its own, while the live scene changes.
class BakeAside {
public:
    /// own: must outlive this.
    BakeAside(StandingScene standing, const Lumels& own, const LinksOptions& options,
              double target_error);
    /// Stops, and waits for the present step: a fraction of a second.
    ~BakeAside() { stop(); }
    BakeAside(const BakeAside&) = delete;
    BakeAside& operator=(const BakeAside&) = delete;

    void stop() { stop_.request_stop(); }
    /// Waits for at most `wait`. Returns true if it has ended or stopped.
    bool has_ended(std::chrono::milliseconds wait) const;
    /// Waits for the light, once; empty if stopped before. Throws what bake_standing() throws.
    std::optional<BakedLight> take();

private:
    std::stop_source stop_;
    std::future<BakedLight> light_;
};

}  // namespace lumel
