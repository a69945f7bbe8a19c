#pragma once
// Maps of the light of single lamps: bake --per-lamp.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "atlas/finish/finish.h"
#include "atlas/prepare/solve_scene.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "links/trace/links.h"
#include "results/files/folder.h"
#include "results/files/lamps_in_scene.h"

namespace lumel {

/// Lamps with the light of each.
struct LampLights {
    std::vector<NamedLamp> lamps;
    std::vector<LinkRadiosity::LampLight> light;  ///< [lamps]
};

/// Colour of the light that a lamp gives to all lumels [N], its largest channel 1; white if none.
glm::dvec3 lamp_colour(std::span<const glm::vec3> irradiance);

/// Keeps lamps apart if that is wanted or there are groups. Throws Error{input} for a method other
/// than links.
void set_per_lamp(BakeOptions& options, bool wanted, std::vector<LampGroup> groups);

/// The light of lamps that a solver kept apart, in a stage of its own; empty if it did not, or the
/// caller stopped.
std::optional<LampLights> keep_lamps_apart(Solver& solver, Stages& stages);

/// Finished maps of the light [N] [lx] and, as layers, of its lamps, which add up to it: none is
/// negative.
FinishedMaps lamp_maps(const SolveScene& prepared, std::span<const glm::vec3> irradiance,
                       const std::vector<LinkRadiosity::LampLight>& lamps);

/// Names of the lamps' maps, without pages and ending: "lamp-" and the lamp's name, as far as files
/// can have it.
std::vector<std::string> lamp_map_names(const std::vector<NamedLamp>& lamps);

/// Result of write_lamps().
struct WrittenLamps {
    std::vector<std::string> files;   ///< names
    std::vector<Image> maps;          ///< [lamps] irradiance [lx]
    std::vector<SceneLamp> in_scene;  ///< [lamps] of these maps
};

/// Writes the maps and lamps.json.
WrittenLamps write_lamps(const OutputFolder& folder, const BakeOptions& options,
                         const SolveScene& prepared, std::span<const glm::vec3> irradiance,
                         const LampLights& lamps, Stages& stages);

/// Removes lamps.json, daylight.json and their maps of an earlier bake from the folder `target`:
/// those that its report lists.
void outdate_apart(OutputFolder& folder, const std::string& target);

}  // namespace lumel
