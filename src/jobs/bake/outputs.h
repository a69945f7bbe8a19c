#pragma once
// Writes a solved scene to the files of a bake.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "base/images/image_files.h"
#include "base/ranks/ranks.h"
#include "gpu/device.h"
#include "jobs/bake/lamp_maps.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "results/files/folder.h"
#include "results/record/report.h"
#include "scene/values/view.h"

namespace lumel {

class Solver;

struct ReferenceOptions;

/// Results of a solve.
struct Results {
    std::uint64_t shots = 0;
    std::uint64_t iterations = 0;
    double error = -1.0, dark_error = -1.0, eye_error = -1.0;  ///< as in SolverState
    VisibleNoise visible_noise;
    bool interrupted = false;
    std::size_t near_pairs = 0;
    std::vector<ConvergencePoint> curve;
    bool relightable = false;  ///< scene.lumelmat was written
    std::optional<FormFactorRow> form_factors;
    DirectLight lamps;             ///< by sky and lamps
    DirectionalLight directional;  ///< empty if not requested
    std::optional<LampLights> per_lamp = {};
    std::vector<RankCost> ranks = {};  ///< that shared the solve
};

/// Metadata of an EXR file of irradiance.
std::map<std::string, std::string> map_metadata(const Scene& scene);

/// Writes a finished map as NAME.exr [lx], with layers, and NAME.png for display; several pages as
/// NAME-0.exr and so on. exposure: of the PNG [1/lx], 0: fitted to the map. Returns it. Warns of
/// values that half precision cannot hold.
float write_map(const OutputFolder& folder, const std::string& name, const Image& map, bool half,
                const SolveScene& prepared, Stages& stages, float exposure = 0.0f,
                std::span<const Layer> directional = {});

/// Removes files of bakes with another number of pages from the folder.
void outdate_other_pages(OutputFolder& folder, const Pages& pages);

/// Results of write_light().
struct WrittenLight {
    float exposure = 0.0f;     ///< common to all images [1/lx]
    std::optional<View> view;  ///< view of the preview, if there is one
};

/// Writes the maps, the data that update() needs, and the lit scenes. device: for the preview;
/// null: none. A preview that cannot be rendered is a warning. irradiance [N] [lx], error: see
/// Solver::error_estimate(), coefficients: see DirectionalLight. lamps: for scene.glb.
WrittenLight write_light(const OutputFolder& folder, const BakeOptions& options,
                         const SolveScene& prepared, const gpu::Device* device,
                         const std::vector<glm::vec3>& irradiance, const std::vector<float>& error,
                         const std::vector<std::vector<glm::vec3>>& coefficients, Stages& stages,
                         std::span<const SceneLamp> lamps = {});

/// Writes all files of `lumel bake` but `more`, which the report lists too; the caller commits
/// them. irradiance [N] [lx].
BakeSummary write_bake(OutputFolder& folder, const BakeOptions& options, const SolveScene& prepared,
                       const gpu::Device& device, const Solver& solver,
                       const std::vector<glm::vec3>& irradiance, const Results& results,
                       const std::vector<std::string>& more, Stages& stages);

/// Writes all files of `lumel reference`.
BakeSummary write_reference(OutputFolder& folder, const BakeOptions& options,
                            const ReferenceOptions& reference, const SolveScene& prepared,
                            const std::vector<glm::vec3>& irradiance, bool stopped, Stages& stages);

}  // namespace lumel
