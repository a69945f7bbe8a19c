#pragma once
// lumel why: where the light of a place in a finished lightmap comes from.

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "jobs/solve/bake_options.h"

namespace lumel {

struct WhyOptions {
    glm::dvec2 place{0.5};  ///< in the lightmap as TEXCOORD_1 has it: 0…1, from the top left corner
    std::optional<glm::ivec2> texel;  ///< column and row of the lightmap, instead
    int page = 0;                     ///< of the lightmap that these are in
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
    int width = 1280;    ///< of why.png [pixels], 0: none
};

/// One sender of light.
struct WhyRow {
    double share = 0.0;               ///< of all the luminance that arrives, 0…1
    std::string name;                 ///< of the instance or the lamp, or "sky"
    std::string material;             ///< empty: no surface
    std::optional<glm::dvec3> place;  ///< in the world [m]; none: infinitely far away
    double distance = 0.0;            ///< [m]
    glm::vec3 light{0.0f};            ///< that arrives [lx]
};

struct WhySummary {
    std::string instance;                                 ///< that the lumel belongs to
    glm::ivec2 texel{0};                                  ///< of the lumel, in its page
    int page = 0;                                         ///< of the lightmap
    glm::dvec3 place{0.0};                                ///< in the world [m]
    glm::vec3 solved{0.0f};                               ///< H of the bake [lx]
    glm::vec3 found{0.0f};                                ///< Σ light of the rows [lx]
    std::vector<WhyRow> rows;                             ///< most light first; shares add up to 1
    std::vector<std::pair<std::string, double>> by_name;  ///< shares, largest first
    std::string report;                                   ///< JSON
};

/// Asks a folder that lumel bake wrote. Writes why.png into it: the scene with what sends light to
/// the lumel coloured by how much, and the lumel marked. Throws Error{input} if the folder has no
/// solution.exr, or if no surface is at that place.
WhySummary why(const std::string& folder, const WhyOptions& options,
               const ProgressFunction& progress = {});

}  // namespace lumel
