#pragma once
// report.json: scene, settings, results and cost of a bake or animation.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "base/json/json_view.h"
#include "base/ranks/ranks.h"
#include "solve/solver/solver_state.h"

namespace lumel {

/// Format of report.json, in its member "format"; readers refuse all others. 1, which the file did
/// not state, had all settings as strings.
inline constexpr int kReportFormat = 4;

/// One stage of the bake, in order.
struct StageTime {
    std::string name;
    double wall_seconds = 0.0;
    double cpu_seconds = 0.0;  ///< over all threads
};

/// The solver's error estimate after a number of shooters.
struct ConvergencePoint {
    std::uint64_t shots = 0;
    double seconds = 0.0;  ///< solving time
    double error = 0.0;    ///< estimated relative error
};

/// Work done for one frame by --solver links.
struct LinksRow {
    std::uint64_t retraced = 0;  ///< links
    double direct = 0.0;         ///< fraction of direct light recomputed
    std::uint64_t sweeps = 0;
    double error = -1.0;  ///< estimated, relative; < 0: not baked
};

/// One image of an animation.
struct FrameRow {
    std::string file;
    double seconds = 0.0;           ///< scene time
    double update_ms = 0.0;         ///< duration of the light's update
    std::uint64_t hemicubes = 0;    ///< during the update
    double residual = 0.0;          ///< unshot light relative to all
    bool at_rest = false;           ///< converged
    std::optional<LinksRow> links;  ///< instead of hemicubes
};

/// Statistics of form factors before reciprocity and row sums were enforced.
struct FormFactorRow {
    std::uint64_t patches = 0;
    std::uint64_t closed = 0;    ///< patches whose row must sum to 1
    double voxel = 0.0;          ///< voxel side of the patches [m]
    double reciprocity = 0.0;    ///< Σ |A_i F_ij - A_j F_ji| / Σ A_i F_ij
    double row_sum = 0.0;        ///< RMS of Σ_j F_ij - 1 over closed rows
    double worst_row_sum = 0.0;  ///< largest |Σ_j F_ij - 1| over these
};

/// Corrections of a bake for an edited scene.
struct UpdateRow {
    std::uint64_t moved = 0, appeared = 0, vanished = 0;  ///< instances
    std::uint64_t recoloured = 0;  ///< instances that reflect or emit differently
    bool relit = false;            ///< sky or lamps that are not surfaces changed
    std::uint64_t rays = 0;        ///< traced for changes of incoming light
    std::uint64_t particles = 0;   ///< transporting it
    std::uint64_t links = 0;       ///< stored; `rays` of them were retraced; 0: none are stored
    bool solved_anew = false;      ///< too much changed for these; Report::shots are the solver's
    double residual = 0.0;         ///< error of the correction relative to all light
    double error_before = -1.0;    ///< estimated relative error before the correction, < 0: unknown

    bool any() const { return moved + appeared + vanished + recoloured > 0 || relit; }
};

/// View of preview.png.
struct PreviewRow {
    glm::dvec3 eye{0.0};        ///< [m], in the file's own coordinates
    glm::dvec3 direction{0.0};  ///< unit
    double vertical_fov = 0.0;  ///< vertical [degrees]
};

/// All contents of report.json. Empty strings, empty lists and negative numbers are unknown values,
/// omitted from the file.
struct Report {
    std::string lumel_version;
    std::string date;  ///< with offset, see local_time()
    std::map<std::string, std::string> library_versions;

    std::string scene;                ///< name of the file, without its folder
    std::string scene_hash;           ///< Scene::hash
    Json settings = Json::object();   ///< option values by name
    std::optional<Json> lights = {};  ///< see light_settings()
    std::optional<Json> solver = {};  ///< see solver_settings(), as far as it applies

    std::string device;  ///< name of the GPU or its replacement
    std::string driver;
    std::string vulkan;  ///< API version

    int atlas_width = 0;   ///< [texels]
    int atlas_height = 0;  ///< [texels]
    int pages = 1;         ///< equal squares of the atlas, in rows, one file each
    double texels_per_metre = 0.0;
    std::uint64_t charts = 0, lumels = 0, pieces = 0, triangles = 0, instances = 0;
    std::uint64_t buried_lumels = 0;
    std::optional<std::uint64_t> near_pairs;  ///< solved exactly
    int picture_width = 0;                    ///< [pixels], 0: maps, no image
    int picture_height = 0;                   ///< [pixels]

    std::uint64_t shots = 0;
    std::uint64_t iterations = 0;
    std::uint64_t directional_shots = 0;  ///< 0: no directional layers
    std::string rays;                     ///< ray tracing backend: "host", "query" or "raster"
    double estimated_error = -1.0;        ///< relative, < 0: unknown
    double estimated_dark_error = -1.0;   ///< see SolverState::dark_error
    double estimated_eye_error = -1.0;    ///< see SolverState::eye_error
    VisibleNoise visible_noise;
    bool interrupted = false;
    std::optional<float> exposure;  ///< exposure of the map's or images' PNG [1/lx or m²/cd]
    std::vector<ConvergencePoint> convergence;
    std::vector<FrameRow> frames;
    std::optional<FormFactorRow> form_factors;
    std::optional<UpdateRow> update;
    std::optional<PreviewRow> preview;

    double wall_seconds = 0.0;
    double cpu_seconds = 0.0;
    std::vector<StageTime> stages;
    /// Kernel or pass name and its runs, in GPU timestamps [ms].
    std::vector<std::pair<std::string, std::vector<double>>> gpu_milliseconds;
    std::vector<RankCost> ranks;  ///< processes that shared the solve
    std::int64_t peak_host_bytes = -1;
    std::int64_t peak_gpu_bytes = -1;

    std::vector<std::string> files;     ///< beside the report
    std::vector<std::string> warnings;  ///< sentences for the user
    std::vector<std::string> notes;
};

/// JSON in fixed order, with units and encodings. See docs/report.md.
Json to_json(const Report& report);

}  // namespace lumel
