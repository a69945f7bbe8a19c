#pragma once
// lumel probes: light in the air of a finished bake, as spherical harmonics.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/prepare/solve_scene.h"
#include "base/json/json_file.h"
#include "jobs/solve/bake_options.h"
#include "results/files/folder.h"
#include "results/measure/light_probe.h"
#include "results/measure/probe_grid.h"
#include "scene/load/probe_places.h"

namespace lumel {

/// In addition to probes named in the scene.
struct ProbesOptions {
    double spacing = 0.0;                         ///< spacing of a grid [m]; 0: none
    std::optional<std::array<double, 6>> bounds;  ///< two corners of the grid; default: the scene's
    std::vector<glm::dvec3> places;               ///< world space [m]
    std::uint32_t samples = LightProbeOptions{}.samples;
    std::string file;  ///< JSON to write; empty: kProbesFile in the folder
};

struct ProbeRow {
    ProbePlace place;
    ProbeLight light;
};

struct ProbesSummary {
    std::vector<ProbeRow> rows;  ///< grid first
    std::optional<ProbeGrid> grid;
    std::size_t inside = 0;  ///< number of probes inside objects
    std::string file;        ///< path of the JSON file
    std::string report;      ///< its contents
};

/// Coefficients for files: red, green and blue of each in turn.
Json coefficients_of(const ProbeLight& light);

/// Throws Error{input} if a grid over this scene would have too many probes.
void check_probe_spacing(double spacing, const SolveScene& prepared);

/// Computes probes for a bake that is not yet committed; writes kProbesFile, and adds the probes to
/// scene.glb and scene-baked.glb. Uses a grid of this spacing, like the overload below. Throws
/// Error, of kind `stopped` if the caller stops it; the bake's files are then unchanged.
void add_probes(const OutputFolder& written, double spacing, const ProgressFunction& progress);

/// Computes probes for the folder of a bake. Throws Error.
ProbesSummary probes(const std::string& folder, const ProbesOptions& options,
                     const ProgressFunction& progress = {});

}  // namespace lumel
