#pragma once
// What a finished bake is: of what, as it was asked for, and what came of it. report.json is made
// from it, and what works on a bake later reads it back.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas/packing/atlas.h"
#include "base/images/lightmap_format.h"
#include "methods/options.h"
#include "results/directional/directional.h"
#include "results/record/report.h"
#include "scene/sky/light_options.h"
#include "scene/values/parts.h"

namespace lumel {

/// Files of a finished bake that are read again.
inline constexpr const char *kReportFile = "report.json", *kSceneFile = "scene.glb",
                            *kSolutionFile = "solution.exr", *kPreview = "preview.png";
/// What lumel report and lumel probes make of them, stale once they are others.
inline constexpr const char *kPageFile = "report.html", *kProbesFile = "probes.json";

/// What the side of the texture of scene-baked.glb is limited to, unless another is asked for or
/// the lightmap is larger [texels].
inline constexpr int kBakedSize = 2048;

struct BakeRecord {
    std::string scene;       ///< name of the file, without its folder
    std::string scene_hash;  ///< Scene::hash of what was baked

    LightOptions lights;
    AtlasOptions atlas;
    SolverOptions solver;
    std::uint32_t sky_directions = 0;
    Parts parts = Parts::all;
    Directional directional = Directional::none;
    bool half = false;
    bool keep_lights = false;
    LightmapFormat lightmap_format = LightmapFormat::ktx2;
    int baked_size = kBakedSize;
    std::uint32_t keep_links = 0;  ///< rays of each lumel that are kept, 0: none

    Pages pages;                    ///< of the square atlas
    double texels_per_metre = 0.0;  ///< as laid out
    std::uint64_t shots = 0, iterations = 0;
    double error = -1.0;       ///< estimated relative error, < 0: not known
    double dark_error = -1.0;  ///< the same of dark lumels, see SolverState
    bool interrupted = false;
    std::optional<float> exposure;   ///< of its pictures [1/lx]
    std::vector<std::string> files;  ///< written
};

/// The options of an atlas as settings of a report.
Json atlas_settings(const AtlasOptions& options);

/// The one writer: what report.json says of the record. The rest of the report is left empty.
Report report_of(const BakeRecord& record);

/// The one reader: of a report's JSON. folder: that relative paths begin at. Throws Error{input}
/// with the place of a field that is missing, of another type or out of bounds, and for reports of
/// another form.
BakeRecord record_of(const JsonView& report, const std::string& folder);

/// Reads the record of a folder. Throws Error{input} if it is not a bake's.
BakeRecord read_bake_record(const std::string& folder);

/// Throws Error{input} for a bake of a part of the light.
void check_whole(const std::string& folder, const BakeRecord& baked);

/// Throws Error{input} for a bake that update() cannot correct: of glossy surfaces, with
/// directional layers, or of a part of the light.
void check_correctable(const std::string& folder, const BakeRecord& baked);

}  // namespace lumel
