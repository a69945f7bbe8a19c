#pragma once
// From a solved scene to the files of a bake.

#include <string>
#include <vector>

#include "atlas/prepare/prepare.h"
#include "base/images/image_files.h"
#include "gpu/device.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "results/files/folder.h"
#include "results/record/report.h"
#include "scene/values/view.h"

namespace lumel {

class Solver;

struct ReferenceOptions;

/// What a solve has come to.
struct Results {
    std::uint64_t shots = 0;
    std::uint64_t iterations = 0;
    double error = -1.0, dark_error = -1.0;
    bool interrupted = false;
    std::size_t near_pairs = 0;
    std::vector<ConvergencePoint> curve;
    bool relightable = false;  ///< scene.lumelmat was written
    std::optional<FormFactorRow> form_factors;
    DirectLight lamps;             ///< of sky and lamps
    DirectionalLight directional;  ///< empty if not asked for
};

/// Writes a finished map as NAME.exr [lx], with layers beside it, and NAME.png for looking; of
/// several pages as NAME-0.exr and so on.
/// exposure of the latter [1/lx], 0: that suits the map. Returns it. Warns of what half precision
/// cannot hold.
float write_map(const OutputFolder& folder, const std::string& name, const Image& map, bool half,
                const Prepared& prepared, Stages& stages, float exposure = 0.0f,
                std::span<const Layer> directional = {});

/// Takes from the folder what a bake with other pages has left there.
void outdate_other_pages(OutputFolder& folder, const Pages& pages);

/// What write_light() wrote.
struct WrittenLight {
    float exposure = 0.0f;     ///< of all pictures [1/lx]
    std::optional<View> view;  ///< that the preview shows, if there is one
};

/// Writes the maps, what update() needs to find the solution again, and the scenes lit by it.
/// device: for the preview, which is left out without one, and with a warning where it cannot be
/// made. irradiance [N] [lx], coefficients as of DirectionalLight.
WrittenLight write_light(const OutputFolder& folder, const BakeOptions& options,
                         const Prepared& prepared, const gpu::Device* device,
                         const std::vector<glm::vec3>& irradiance,
                         const std::vector<std::vector<glm::vec3>>& coefficients, Stages& stages);

/// Writes all files of `lumel bake`; to commit them is left to the caller. irradiance [N] [lx].
BakeSummary write_bake(OutputFolder& folder, const BakeOptions& options, const Prepared& prepared,
                       const gpu::Device& device, const Solver& solver,
                       const std::vector<glm::vec3>& irradiance, const Results& results,
                       Stages& stages);

/// Writes all files of `lumel reference`.
BakeSummary write_reference(OutputFolder& folder, const BakeOptions& options,
                            const ReferenceOptions& reference, const Prepared& prepared,
                            const std::vector<glm::vec3>& irradiance, bool stopped, Stages& stages);

}  // namespace lumel
