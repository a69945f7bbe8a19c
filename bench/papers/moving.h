#pragma once
// The scenes of [Hoef13] section 5.1, and what comes of a move in them.

#include <string>
#include <vector>

#include "base/core/image.h"
#include "methods/redistribution/live_scene.h"

namespace lumel::bench {

/// A scene of our own after one of the thesis's, with a box that turns.
struct ThesisScene {
    const char* key;    ///< on the command line
    const char* title;  ///< in the thesis
    const char* path;
    int picture;  ///< n of figure 5.2.n
    bool low_quality = false;
};

inline constexpr ThesisScene kThesisScenes[] = {
    {"indirect", "Indirect light", "scenes/moving-indirect.gltf", 1},
    {"large", "Cornell, large", "scenes/moving-large-lamp.gltf", 2},
    {"small", "Cornell, small", "scenes/moving-small-lamp.gltf", 3},
    {"low", "Low quality", "scenes/moving-large-lamp.gltf", 4, true},
};

/// Name of what turns.
inline constexpr const char* kBox = "box";

/// The box's place once it has turned about its own upright axis.
glm::mat4 turned(const Scene& scene, std::uint32_t box, double degrees);

/// What the host and the device did for one move.
struct Update {
    double alone_ms = 0.0;      ///< redistribution alone, wall time
    double whole_ms = 0.0;      ///< until at rest, wall time
    double alone_cpu_ms = 0.0;  ///< the same in processor time
    double whole_cpu_ms = 0.0;
    std::uint64_t alone_hemicubes = 0;  ///< of redistribution alone
    std::uint64_t whole_hemicubes = 0;
    gpu::StageTimes alone_stages;  ///< device time of redistribution alone
    gpu::StageTimes stages;        ///< until at rest
    std::vector<glm::vec3> alone;  ///< H [N] after redistribution alone
};

/// Moves an instance and goes on until at rest.
Update update_after_move(LiveScene& live, std::uint32_t instance, const glm::mat4& place);

/// H of lumels in a row, those that are not buried covered: for compare_maps().
Image in_a_row(const Lumels& lumels, const std::vector<glm::vec3>& irradiance);

/// H [N] before and after a move.
struct BeforeAndAfter {
    std::vector<glm::vec3> before, after;
};

/// Distance of a solution from another after a move.
struct ShareOfMove {
    double change;  ///< by the move in the other, relative RMSE
    double left;    ///< distance of the solutions, relative to it
    double missed;  ///< distance of the changes, relative to it: a standing offset cancels
};
ShareOfMove share_of_move(const Lumels& lumels, const BeforeAndAfter& found,
                          const BeforeAndAfter& wanted);

}  // namespace lumel::bench
