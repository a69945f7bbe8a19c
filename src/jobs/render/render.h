#pragma once
// lumel render: a picture of a scene from one of its cameras, gloss and all.

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/image.h"
#include "jobs/solve/bake_options.h"

namespace lumel {

/// Pictures of a scene's animation, each solved from the light of the one before.
struct FilmOptions {
    int frames = 0;             ///< 0: one picture of the scene as it stands in the file
    double fps = 24.0;          ///< [1/s]
    std::size_t animation = 0;  ///< index into the file's animations
    /// Of the average of the frame before, in terms of its iterations. More is less noise, and
    /// light that lags behind more.
    double kept = 1.0;
    bool fresh = false;  ///< solves each frame from nothing
};

struct RenderOptions {
    /// The solution the picture is made from; its method is GlossyOptions.
    /// No map is shown: its sides may share their texels.
    BakeOptions bake{.atlas = {.sides = Sides::brighter}, .solver = {.method = GlossyOptions{}}};
    int camera = -1;          ///< index into the file's cameras; -1: the first, or one chosen
    int width = 1280;         ///< [pixels]
    int height = 0;           ///< [pixels]; 0: by the camera's aspect
    std::uint32_t sets = 16;  ///< places looked at within a pixel
    // Of no account with Scheme::paper, whose solution lights the eye's image of each lumel:
    std::uint64_t shots = 0;  ///< shooters for the eye, after those of the solution
    std::uint32_t rays = 4;   ///< along the lobe at each place
    FilmOptions film;         ///< of files; scenes in memory have no animation
    int paths = 0;            ///< > 0: path traced on the CPU instead, with this number per pixel
};

struct RenderSummary {
    int width = 0;  ///< [pixels]
    int height = 0;
    std::uint64_t shots = 0;  ///< shooters in all
    double error = -1.0;      ///< estimated, of the irradiance
    double seconds = 0.0;
    bool interrupted = false;
    std::string report;              ///< JSON
    std::vector<std::string> files;  ///< written, without their folder
};

struct Rendered {
    Image image;  ///< radiance [cd/m²], RGBA
    RenderSummary summary;
};

/// A picture of a scene that was read with MaterialModel::glossy. Throws Error.
Rendered render(Scene scene, const RenderOptions& options, const ProgressFunction& progress = {});

/// The same, written to a file: radiance where the name ends in .exr, a tone-mapped .png else. A
/// film's frames get numbers: picture-0001.png, all exposed as the first, and the summary is of the
/// last.
RenderSummary render(const std::string& scene_path, const std::string& picture_path,
                     const RenderOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
