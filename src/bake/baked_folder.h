#pragma once
// What report.json says of a finished bake.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scene/light_options.h"

namespace lumel {

struct BakedFolder {
    std::vector<std::pair<std::string, std::string>> settings;  ///< as Report::settings
    LightOptions lights;                                        ///< the settings among them
    std::string scene_hash;                                     ///< Scene::hash of what was baked
    std::string method;                                         ///< id of the solver
    std::uint32_t seed = 1;
    std::uint64_t shots = 0, iterations = 0;
    double error = -1.0;  ///< estimated relative error, < 0: not known
    double texels_per_metre = 0.0;
    int gutter = 0;  ///< [texels]
    std::uint32_t sky_directions = 0;
    bool centre = false, half = false;
};

/// Throws Error{input} if the folder is not a bake's.
BakedFolder read_baked_folder(const std::string& folder);

/// Throws Error{input} for a bake of a part of the light.
void check_whole(const std::string& folder, const BakedFolder& baked);

/// Throws Error{input} for a bake that update() cannot correct: of glossy surfaces, with
/// directional layers, or of a part of the light.
void check_correctable(const std::string& folder, const BakedFolder& baked);

}  // namespace lumel
