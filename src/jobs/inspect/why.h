#pragma once
// lumel why: contributors to the light at a point of a finished lightmap.

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "jobs/solve/bake_options.h"

namespace lumel {

struct WhyOptions {
    glm::dvec2 place{0.5};  ///< lightmap coordinates as in TEXCOORD_1: 0…1, from the top left
    std::optional<glm::ivec2> texel;  ///< replaces `place`: column and row of the lightmap
    int page = 0;                     ///< lightmap page of these coordinates
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
    int width = 1280;    ///< width of why.png [pixels], 0: none
};

/// One contributor.
struct WhyRow {
    double share = 0.0;               ///< relative to the lumel's luminance, 0…1
    std::string name;                 ///< instance or lamp name, or "sky"
    std::string material;             ///< empty: not a surface
    std::optional<glm::dvec3> place;  ///< world space [m]; empty: infinitely far away
    double distance = 0.0;            ///< [m]
    glm::vec3 light{0.0f};            ///< at the lumel [lx]
};

struct WhySummary {
    std::string instance;                                 ///< instance of the lumel
    glm::ivec2 texel{0};                                  ///< texel of the lumel, in its page
    int page = 0;                                         ///< lightmap page
    glm::dvec3 place{0.0};                                ///< world space [m]
    glm::vec3 solved{0.0f};                               ///< H of the bake [lx]
    glm::vec3 found{0.0f};                                ///< Σ light of the rows [lx]
    std::vector<WhyRow> rows;                             ///< largest share first; shares sum to 1
    std::vector<std::pair<std::string, double>> by_name;  ///< shares, largest first
    std::string remark;                                   ///< by remark_on_rays()
    std::string report;                                   ///< JSON
};

/// A sentence if the luminance that rays find differs from the bake's by more than both errors
/// explain; else empty. noise: standard error of `found` [lx]; error: relative error of `solved`.
std::string remark_on_rays(double solved, double found, double noise, double error);

/// Analyses the folder of a bake. Writes why.png there: the scene with contributors coloured by
/// their light at the lumel, and the lumel marked. Throws Error{input} if the folder has no
/// solution.exr, or there is no surface at that point.
WhySummary why(const std::string& folder, const WhyOptions& options,
               const ProgressFunction& progress = {});

}  // namespace lumel
