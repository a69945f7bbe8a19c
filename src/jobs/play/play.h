#pragma once
// lumel play: renders an animation, with light updated from frame to frame.

#include <cstddef>
#include <string>
#include <variant>

#include "jobs/solve/bake_options.h"
#include "links/live/live_links.h"
#include "methods/directions/leaky_scene.h"
#include "methods/redistribution/live_scene.h"

namespace lumel {

/// Film that ffmpeg makes of the frames.
enum class Film { none, mp4, webm };

struct PlayOptions {
    AtlasOptions atlas;
    /// Progressive radiosity is corrected after a move; directions follow by a leaky average; links
    /// are retraced where the move changes them.
    std::variant<ProgressiveOptions, DirectionsOptions, LinksOptions> solver;
    double leak = LeakyOptions{}.leak;                  ///< with DirectionsOptions
    std::uint32_t link_rays = LiveLinksOptions{}.rays;  ///< per lumel, with LinksOptions
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
    Redistribution redistribution = Redistribution::incremental;
    double residual = LiveOptions{}.residual;  ///< see the options of the method's live scene
    std::size_t animation = 0;                 ///< index into the file's animations
    int frames = 0;                            ///< 0: the animation's length
    double fps = 24.0;                         ///< [1/s]
    double budget_ms = 0.0;                    ///< per update, 0: until converged
    /// With LinksOptions, frames are baked to this estimated relative error; 0, or with a budget:
    /// they show the light of links.
    double bake_error = SolverOptions{}.target_error;
    int camera = -1;        ///< index in the file; -1: the first, or a generated one
    int width = 1280;       ///< [pixels]
    Film film = Film::mp4;  ///< if ffmpeg is installed
    float exposure = 0.0f;  ///< 0: fitted to the first that is not black
};

struct PlaySummary {
    int frames = 0;        ///< written
    double seconds = 0.0;  ///< total
    bool interrupted = false;
    std::string report;  ///< JSON of report.json
};

/// Writes frame-0001.png …, report.json and, if ffmpeg is installed, the film into `folder`. If
/// `progress` returns false, writes the frames done so far. Throws Error.
PlaySummary play(const std::string& scene_path, const std::string& folder,
                 const PlayOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
