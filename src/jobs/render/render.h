#pragma once
// lumel render: an image of a scene from one of its cameras, with gloss.

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/image.h"
#include "jobs/solve/bake_options.h"

namespace lumel {

/// Images of a scene's animation, each solved from the light of the previous one.
struct FilmOptions {
    int frames = 0;             ///< 0: one image of the scene as in the file
    double fps = 24.0;          ///< [1/s]
    std::size_t animation = 0;  ///< index into the file's animations
    /// Weight of the previous frame's average, relative to its iterations. A larger weight reduces
    /// noise and increases lag.
    double kept = 1.0;
    bool fresh = false;  ///< solves each frame from scratch
};

struct RenderOptions {
    /// The solution that the image is made from; its method is GlossyOptions without layers. No map
    /// is shown, so its sides can share texels.
    BakeOptions bake{.atlas = {.sides = Sides::brighter}, .solver = {.method = GlossyOptions{}}};
    int camera = -1;          ///< index in the file; -1: the first, or a generated one
    int width = 1280;         ///< [pixels]
    int height = 0;           ///< [pixels]; 0: by the camera's aspect
    std::uint32_t sets = 16;  ///< sample positions per pixel
    // Unused by Scheme::paper, whose solution lights the eye's image of each lumel:
    std::uint64_t shots = 0;  ///< shooters for the eye, after those of the solution
    std::uint32_t rays = 4;   ///< along the lobe at each sample
    FilmOptions film;         ///< for files only; scenes in memory have no animation
    int paths = 0;            ///< > 0: path traces on the CPU instead, with this number per pixel
    /// Also an image of each lamp, for files only; bake.solver.method is LinksOptions, which keeps
    /// lamps apart.
    bool layers = false;
};

struct RenderSummary {
    int width = 0;  ///< [pixels]
    int height = 0;
    std::uint64_t shots = 0;  ///< total number of shooters
    double error = -1.0;      ///< estimated relative error of the irradiance
    double seconds = 0.0;
    bool interrupted = false;
    std::string report;              ///< JSON
    std::vector<std::string> files;  ///< written, without their folder
};

struct Rendered {
    Image image;  ///< radiance [cd/m²], RGBA
    RenderSummary summary;
};

/// Renders a scene that was read with MaterialModel::glossy. Throws Error.
Rendered render(Scene scene, const RenderOptions& options, const ProgressFunction& progress = {});

/// Renders to a file: radiance for .exr, tone-mapped for .png. A film's frames are numbered:
/// picture-0001.png, all with the exposure of the first; the summary is of the last. Layers: see
/// render_layers().
RenderSummary render(const std::string& scene_path, const std::string& picture_path,
                     const RenderOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
