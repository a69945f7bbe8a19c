#pragma once
// Options, progress and result of a bake.

#include <cstdint>
#include <functional>
#include <string>

#include "atlas/packing/atlas.h"
#include "base/images/lightmap_format.h"
#include "methods/options.h"
#include "raster/shadow_maps/direct_light.h"
#include "results/directional/directional.h"
#include "results/record/bake_record.h"
#include "scene/gltf/compression.h"
#include "scene/sky/light_options.h"
#include "scene/values/parts.h"

namespace lumel {

struct BakeOptions {
    LightOptions lights;
    AtlasOptions atlas;
    SolverOptions solver;
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
    std::uint32_t sky_directions = DirectLightOptions{}.sky_directions;
    Parts parts = Parts::all;                               ///< light in the lightmap
    bool half = false;                                      ///< lightmap.exr in half precision
    bool keep_lights = false;                               ///< keeps baked lights in scene.glb
    LightmapFormat lightmap_format = LightmapFormat::ktx2;  ///< in scene.glb
    Compression compression = Compression::none;            ///< of the geometry in scene.glb
    int baked_size = kBakedSize;  ///< maximum side of the texture of scene-baked.glb [texels]
    Directional directional = Directional::none;  ///< extra layers of lightmap.exr
    int preview_width = 1280;                     ///< [pixels], 0: no preview
    float exposure = 0.0f;       ///< of preview and other images for display [m²/cd]; 0: fitted
    double probe_spacing = 0.0;  ///< spacing of a grid of light probes [m]; 0: none
    std::string daylight;        ///< weather file, for maps of daylight over a year; empty: none
    bool keep_links = false;     ///< stores the links for later runs
    std::string dump;            ///< folder for intermediate images, see dump.h; empty: none
    bool resume = false;         ///< continues from a checkpoint, if there is one
    std::size_t ranks = 1;       ///< processes that share the bake; bake() sets it
    double checkpoint_seconds = 60.0;  ///< between checkpoints, see Checkpoint; 0: none
    /// Limit for host and device each [bytes]; 0: available memory.
    std::uint64_t max_memory = 0;
};

/// Status of a running bake, for a progress display.
struct BakeProgress {
    std::string stage;        ///< "reading", "charts", "near field", "uploading", "solving", …
    double fraction = 0.0;    ///< progress of the stage, 0…1
    std::uint64_t shots = 0;  ///< shooters
    double error = -1.0;      ///< estimated relative error, < 0: unknown
    double seconds = 0.0;     ///< since the start of the stage
    std::string note;         ///< a new one-line fact, or empty
};

/// Called from the baking thread at the start and end of each stage, with every note, and often
/// while solving; false ends the solve early (the best solution so far is still written).
using ProgressFunction = std::function<bool(const BakeProgress&)>;

struct BakeSummary {
    std::uint64_t shots = 0;
    double error = -1.0;      ///< estimated relative error
    double eye_error = -1.0;  ///< as in SolverState
    VisibleNoise visible_noise;
    double seconds = 0.0;  ///< total
    bool interrupted = false;
    std::string report;  ///< JSON of report.json
};

}  // namespace lumel
