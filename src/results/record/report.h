#pragma once
// report.json: what was baked or shown, how, and what it took.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "base/json/json_view.h"

namespace lumel {

/// Of the form of report.json, in its member "format". What reads it back refuses all others. 1,
/// which the file did not say, had all settings as strings.
inline constexpr int kReportFormat = 4;

/// One stage of the bake, in order.
struct StageTime {
    std::string name;
    double wall_seconds = 0.0;
    double cpu_seconds = 0.0;  ///< of all threads
};

/// The estimate of the solver after a number of shooters.
struct ConvergencePoint {
    std::uint64_t shots = 0;
    double seconds = 0.0;  ///< of solving
    double error = 0.0;    ///< estimated relative error
};

/// What a picture took over kept links.
struct LinksRow {
    std::uint64_t retraced = 0;  ///< links
    double direct = 0.0;         ///< share of direct light that was found again
    std::uint64_t sweeps = 0;
};

/// A picture of a moving scene.
struct FrameRow {
    std::string file;
    double seconds = 0.0;           ///< of the scene's own time
    double update_ms = 0.0;         ///< that the light took to follow
    std::uint64_t hemicubes = 0;    ///< for it
    double residual = 0.0;          ///< light still to be shot, as a part of all
    bool at_rest = false;           ///< nothing was left to do
    std::optional<LinksRow> links;  ///< in place of hemicubes
};

/// Form factors between patches, as they were found, before reciprocity and row sums were enforced.
struct FormFactorRow {
    std::uint64_t patches = 0;
    std::uint64_t closed = 0;    ///< of them: those whose row has to add up to 1
    double voxel = 0.0;          ///< side of the voxels that made the patches [m]
    double reciprocity = 0.0;    ///< Σ |A_i F_ij - A_j F_ji| / Σ A_i F_ij
    double row_sum = 0.0;        ///< root mean square of Σ_j F_ij - 1 of closed rows
    double worst_row_sum = 0.0;  ///< the largest of these
};

/// What became of a bake whose scene was edited.
struct UpdateRow {
    std::uint64_t moved = 0, appeared = 0, vanished = 0;  ///< instances
    std::uint64_t recoloured = 0;  ///< instances that reflect or emit differently
    bool relit = false;            ///< sky or lamps that are no surfaces are others
    std::uint64_t rays = 0;        ///< followed to find the change of arriving light
    std::uint64_t particles = 0;   ///< that carried it on
    std::uint64_t links = 0;       ///< kept, of which `rays` were traced again; 0: none are kept
    bool solved_anew = false;      ///< too much changed for these; Report::shots is their solver's
    double residual = 0.0;         ///< error of the correction, as a part of all light
    double error_before = -1.0;    ///< estimated relative error of what was corrected, < 0: unknown

    bool any() const { return moved + appeared + vanished + recoloured > 0 || relit; }
};

/// From where preview.png shows the scene.
struct PreviewRow {
    glm::dvec3 eye{0.0};        ///< [m], in the file's own coordinates
    glm::dvec3 direction{0.0};  ///< unit
    double vertical_fov = 0.0;  ///< of the picture [degrees]
};

/// All contents of report.json. Empty strings, empty lists and negative numbers: not known; left
/// out of the file.
struct Report {
    std::string lumel_version;
    std::string date;  ///< with its offset, as of local_time()
    std::map<std::string, std::string> library_versions;

    std::string scene;                ///< name of the file, without its folder
    std::string scene_hash;           ///< Scene::hash
    Json settings = Json::object();   ///< values of options by their names
    std::optional<Json> lights = {};  ///< as of light_settings()
    std::optional<Json> solver = {};  ///< as of solver_settings(), as far as it applies

    std::string device;  ///< name of the GPU, or of what was used in its place
    std::string driver;
    std::string vulkan;  ///< API version

    int atlas_width = 0;   ///< [texels]
    int atlas_height = 0;  ///< [texels]
    int pages = 1;         ///< equal squares of it, in rows, each a file
    double texels_per_metre = 0.0;
    std::uint64_t charts = 0, lumels = 0, pieces = 0, triangles = 0, instances = 0;
    std::uint64_t buried_lumels = 0;
    std::optional<std::uint64_t> near_pairs;  ///< of lumels, solved exactly
    int picture_width = 0;                    ///< [pixels], 0: maps were made, no picture
    int picture_height = 0;                   ///< [pixels]

    std::uint64_t shots = 0;
    std::uint64_t iterations = 0;
    std::uint64_t directional_shots = 0;  ///< 0: no directional layers
    std::string rays;                     ///< what cast the method's: "host", "query" or "raster"
    double estimated_error = -1.0;        ///< relative, < 0: not known
    double estimated_dark_error = -1.0;   ///< of lumels below a third of the mean, of their own
    bool interrupted = false;
    std::optional<float> exposure;  ///< of the map's or the pictures' PNG [1/lx or m²/cd]
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
    std::int64_t peak_host_bytes = -1;
    std::int64_t peak_gpu_bytes = -1;

    std::vector<std::string> files;     ///< written beside the report
    std::vector<std::string> warnings;  ///< sentences for the user
    std::vector<std::string> notes;
};

/// Units and encodings are added; members come in a fixed order. See docs/report.md.
Json to_json(const Report& report);

}  // namespace lumel
