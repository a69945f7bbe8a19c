#pragma once
// lumel probes: the light in the air of a finished bake, as spherical harmonics.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/prepare/prepare.h"
#include "base/json/json_file.h"
#include "jobs/solve/bake_options.h"
#include "results/files/folder.h"
#include "results/measure/light_probe.h"
#include "results/measure/probe_grid.h"
#include "scene/load/probe_places.h"

namespace lumel {

/// Beside the probes that the scene names itself.
struct ProbesOptions {
    double spacing = 0.0;                         ///< of a grid [m]; 0: none
    std::optional<std::array<double, 6>> bounds;  ///< of the grid: two corners; else the scene's
    std::vector<glm::dvec3> places;               ///< in the world [m]
    std::uint32_t samples = LightProbeOptions{}.samples;
    std::string file;  ///< JSON to write; empty: kProbesFile in the folder
};

struct ProbeRow {
    ProbePlace place;
    ProbeLight light;
};

struct ProbesSummary {
    std::vector<ProbeRow> rows;  ///< those of the grid first
    std::optional<ProbeGrid> grid;
    std::size_t inside = 0;  ///< probes inside of things
    std::string file;        ///< that was written, or is to be
    std::string report;      ///< JSON: what it holds
};

/// Coefficients as files have them: red, green and blue of each in turn.
Json coefficients_of(const ProbeLight& light);

/// Throws Error{input} if a grid over this scene would have too many probes.
void check_probe_spacing(double spacing, const Prepared& prepared);

/// Finds the light at probes of a bake that is written and not yet committed, and writes
/// kProbesFile and the probes into scene.glb and scene-baked.glb beside it. The first is that of
/// the function below. Throws Error, of kind `stopped` if the caller wanted to stop: then
/// what the bake wrote is as it was.
void add_probes(const OutputFolder& written, double spacing, const ProgressFunction& progress);

/// Finds the light at probes in a folder that lumel bake wrote. Throws Error.
ProbesSummary probes(const std::string& folder, const ProbesOptions& options,
                     const ProgressFunction& progress = {});

}  // namespace lumel
