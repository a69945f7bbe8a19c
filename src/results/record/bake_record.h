#pragma once
// Record of a finished bake: scene, settings and results. report.json is made from it, and later
// commands read it back.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas/packing/atlas.h"
#include "base/images/lightmap_format.h"
#include "methods/options.h"
#include "results/directional/directional.h"
#include "results/record/report.h"
#include "scene/gltf/compression.h"
#include "scene/sky/light_options.h"
#include "scene/values/parts.h"

namespace lumel {

/// Files of a finished bake that are read again.
inline constexpr const char *kReportFile = "report.json", *kSceneFile = "scene.glb",
                            *kSolutionFile = "solution.exr", *kPreview = "preview.png",
                            *kLampsFile = "lamps.json", *kDaylightFile = "daylight.json";
/// Beginnings of the names of maps of single lamps, and of hours of daylight.
inline constexpr const char *kLampPrefix = "lamp-", *kDaylightPrefix = "daylight-";
/// Layer of solution.exr, see write_solution().
inline constexpr const char* kErrorLayer = "error";
/// Output of lumel report and lumel probes, outdated by a new bake.
inline constexpr const char *kPageFile = "report.html", *kProbesFile = "probes.json";

/// Default limit on the texture side of scene-baked.glb, unless the lightmap is larger [texels].
inline constexpr int kBakedSize = 2048;

struct BakeRecord {
    std::string scene;       ///< name of the file, without its folder
    std::string scene_hash;  ///< Scene::hash of the baked scene

    LightOptions lights;
    AtlasOptions atlas;
    SolverOptions solver;
    std::uint32_t sky_directions = 0;
    Parts parts = Parts::all;
    Directional directional = Directional::none;
    bool half = false;
    bool keep_lights = false;
    LightmapFormat lightmap_format = LightmapFormat::ktx2;
    Compression compression = Compression::none;
    int baked_size = kBakedSize;
    float given_exposure = 0.0f;   ///< by the user [m²/cd]; 0: fitted
    std::uint32_t keep_links = 0;  ///< stored rays per lumel, 0: none

    Pages pages;                    ///< pages of the square atlas
    double texels_per_metre = 0.0;  ///< in the atlas
    std::uint64_t shots = 0, iterations = 0;
    double error = -1.0;       ///< estimated relative error, < 0: unknown
    double dark_error = -1.0;  ///< as in SolverState
    double eye_error = -1.0;   ///< as in SolverState
    VisibleNoise visible_noise;
    bool interrupted = false;
    std::optional<float> exposure;   ///< exposure of its images [1/lx]
    std::vector<std::string> files;  ///< written
};

/// Options of the bake's solver. Targets that it missed are replaced by what it reached.
SolverOptions reached_targets(const BakeRecord& record);

/// Ray limit per lumel for an update or a state: that of the bake, or, if time or the user ended
/// it, the rays that it sent; 0: none.
std::uint64_t ray_limit(const BakeRecord& record);

/// Atlas options as settings of a report.
Json atlas_settings(const AtlasOptions& options);

/// Report of the record, with all other members empty. The only writer.
Report report_of(const BakeRecord& record);

/// Record from a report's JSON. The only reader. folder: base of relative paths. Throws
/// Error{input} with the location of a field that is missing, of another type or out of range, and
/// for reports of another format.
BakeRecord record_of(const JsonView& report, const std::string& folder);

/// Reads the record of a folder. Throws Error{input} if it is not a bake.
BakeRecord read_bake_record(const std::string& folder);

/// Throws Error{input} if the bake has only part of the light.
void check_whole(const std::string& folder, const BakeRecord& baked);

/// Throws Error{input} if update() cannot correct the bake: glossy surfaces, directional layers, or
/// only part of the light.
void check_correctable(const std::string& folder, const BakeRecord& baked);

}  // namespace lumel
