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
#include "scene/sky/light_options.h"
#include "scene/values/parts.h"

namespace lumel {

struct BakeOptions {
    LightOptions lights;
    AtlasOptions atlas;
    SolverOptions solver;
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
    std::uint32_t sky_directions = DirectLightOptions{}.sky_directions;
    Parts parts = Parts::all;                               ///< of the light that arrives
    bool half = false;                                      ///< lightmap.exr in half precision
    bool keep_lights = false;                               ///< that are baked in scene.glb too
    LightmapFormat lightmap_format = LightmapFormat::ktx2;  ///< of scene.glb
    int baked_size = kBakedSize;  ///< largest side of the texture of scene-baked.glb [texels]
    Directional directional = Directional::none;  ///< layers of lightmap.exr
    int preview_width = 1280;                     ///< [pixels], 0: no preview
    double probe_spacing = 0.0;  ///< of a grid of light probes beside the map [m]; 0: none
    /// Of each lumel that are traced, and kept for later runs: 4, 16, 64 or 256; 0: as many as the
    /// method wants, and none is kept.
    std::uint32_t keep_links = 0;
    std::string dump;                  ///< folder for intermediate images, see dump.h; empty: none
    bool resume = false;               ///< goes on from a checkpoint, if one is there
    double checkpoint_seconds = 60.0;  ///< between two checkpoints, see Checkpoint; 0: none
    /// Of the host and of the device each [bytes]; 0: what they have.
    std::uint64_t max_memory = 0;
};

/// State of a running bake, for a progress display.
struct BakeProgress {
    std::string stage;        ///< "reading", "charts", "near field", "uploading", "solving", …
    double fraction = 0.0;    ///< of the whole stage, 0…1
    std::uint64_t shots = 0;  ///< shooters so far
    double error = -1.0;      ///< estimated relative error, < 0: not known yet
    double seconds = 0.0;     ///< since the stage began
    std::string note;         ///< a fact in one line that has just become known, or empty
};

/// Called from the baking thread at the start and end of each stage, with every note, and
/// often while solving; false ends the solve early (the best solution so far is still written).
using ProgressFunction = std::function<bool(const BakeProgress&)>;

struct BakeSummary {
    std::uint64_t shots = 0;
    double error = -1.0;       ///< estimated relative error
    double dark_error = -1.0;  ///< the same of dark lumels, see SolverState
    double seconds = 0.0;      ///< whole bake
    bool interrupted = false;
    std::string report;  ///< the JSON of report.json
};

}  // namespace lumel
