#pragma once
// lumel play: the animation of a scene as pictures, its light corrected from one to the next.

#include <cstddef>
#include <string>
#include <variant>

#include "jobs/solve/bake_options.h"
#include "links/live/live_links.h"
#include "methods/directions/leaky_scene.h"
#include "methods/redistribution/live_scene.h"

namespace lumel {

/// The file that ffmpeg makes of the pictures.
enum class Film { none, mp4, webm };

struct PlayOptions {
    AtlasOptions atlas;
    /// Progressive radiosity is corrected after a move; directions are a leaky mean, which follows;
    /// links are traced again where the move changes them.
    std::variant<ProgressiveOptions, DirectionsOptions, LinksOptions> solver;
    double leak = LeakyOptions{}.leak;                  ///< with DirectionsOptions
    std::uint32_t link_rays = LiveLinksOptions{}.rays;  ///< of a lumel, with LinksOptions
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
    Redistribution redistribution = Redistribution::incremental;
    double residual =
        LiveOptions{}.residual;  ///< as the options of the method's live scene have it
    std::size_t animation = 0;   ///< index into the file's animations
    int frames = 0;              ///< 0: the animation's length
    double fps = 24.0;           ///< [1/s]
    double budget_ms = 0.0;      ///< of an update, 0: until at rest
    int camera = -1;             ///< index into the file's cameras; -1: the first, or one chosen
    int width = 1280;            ///< [pixels]
    Film film = Film::mp4;       ///< where ffmpeg is installed
    float exposure = 0.0f;       ///< of the pictures, 0: as suits the first one that is not black
};

struct PlaySummary {
    int frames = 0;        ///< written
    double seconds = 0.0;  ///< in all
    bool interrupted = false;
    std::string report;  ///< the JSON of report.json
};

/// Writes frame-0001.png …, report.json and, if ffmpeg is installed, the film into `folder`. If
/// `progress` returns false, the frames done so far. Throws Error.
PlaySummary play(const std::string& scene_path, const std::string& folder,
                 const PlayOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
