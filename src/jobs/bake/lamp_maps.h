#pragma once
// Maps of the light of single lamps: bake --per-lamp.

#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "links/trace/links.h"
#include "results/files/folder.h"

namespace lumel {

/// Lamps with the light of each.
struct LampLights {
    std::vector<NamedLamp> lamps;
    std::vector<LinkRadiosity::LampLight> light;  ///< [lamps]
};

/// Throws Error{input} if lamps are to be kept apart by a method other than links.
void check_per_lamp(const BakeOptions& options, bool wanted);

/// Finished maps of lamps, without negative light. They add up to the map of `irradiance` [N] [lx].
std::vector<Image> lamp_maps(const SolveScene& prepared, std::span<const glm::vec3> irradiance,
                             const std::vector<LinkRadiosity::LampLight>& lamps);

/// Names of the lamps' maps, without pages and ending: "lamp-" and the lamp's name, as far as files
/// can have it.
std::vector<std::string> lamp_map_names(const std::vector<NamedLamp>& lamps);

/// Writes the maps and lamps.json. Returns the names of the files.
std::vector<std::string> write_lamps(const OutputFolder& folder, const BakeOptions& options,
                                     const SolveScene& prepared,
                                     std::span<const glm::vec3> irradiance, const LampLights& lamps,
                                     Stages& stages);

/// Removes maps of lamps of an earlier bake from the folder `target`.
void outdate_lamps(OutputFolder& folder, const std::string& target);

}  // namespace lumel
