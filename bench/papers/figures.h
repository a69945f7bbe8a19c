#pragma once
// The papers' figures. All throw Error and report what they show as they go on.

#include <cstdint>
#include <string>
#include <vector>

#include "bench/papers/report.h"
#include "bench/settings.h"
#include "methods/redistribution/live_scene.h"

namespace lumel::bench {

struct IterationSettings {
    Settings shared;
    std::vector<int> sizes{64, 128, 256, 512, 1024};   ///< sides of the atlas [texels]
    std::vector<int> vertices{10, 100, 1000, 10'000};  ///< that are drawn, about
    int iterations = 12;                               ///< timed at a stretch
};

/// [BJ04] figures 7 and 8: time of an iteration against vertices, for each size of the map.
void time_iterations(const IterationSettings& settings, Report& report);

struct SelectionSettings {
    Settings shared;
    std::vector<int> sizes{64, 128, 256, 512, 1024};  ///< sides of the atlas [texels]
    int draws = 12;                                   ///< timed at a stretch, as are iterations
};

/// [BJ04] section 3.1: drawing by read-back and linear search against drawing on the device.
void time_selection(const SelectionSettings& settings, Report& report);

struct ConvergenceSettings {
    Settings shared;
    std::vector<int> iterations{1, 4, 40, 50, 80, 100};
    std::string folder;  ///< for maps and pictures; empty: none are made
    int width = 256;     ///< of a picture [pixels]
};

/// [BJ04] figures 5 and 6: error and picture after given numbers of iterations.
void follow_convergence(const ConvergenceSettings& settings, Report& report);

struct VisibilitySettings {
    Settings shared;
    std::string folder;  ///< for the pictures
};

/// [BJ04] figures 2 and 3: the patch of every texel, and what a shooter sees.
void show_visibility(const VisibilitySettings& settings, Report& report);

struct GlossyPicturesSettings {
    Settings shared;
    int iterations = 100;  ///< of the solution; the default takes as many more for the eye
    int width = 256;       ///< of a picture [pixels]
    int paths = 1024;      ///< per pixel, to compare with
    std::string folder;    ///< for the pictures
};

/// [BSS05] figures 1 and 2: pictures and their times.
void take_glossy_pictures(const GlossyPicturesSettings& settings, Report& report);

struct AblationSettings {
    Settings shared;
    int seeds = 8;
    int width = 160;           ///< of the picture [pixels]
    int solving_shots = 2048;  ///< before an eye looks
    int eye_shots = 512;       ///< for the eye
    int rays = 16;             ///< along the lobe at each place
    int iterations = 80;       ///< of the papers' scheme, for the disc
};

/// [BSS05] section 5: variance with and without its remedies.
void ablate(const AblationSettings& settings, Report& report);

struct FramesSettings {
    Settings shared;
    std::string thing = "tall block";     ///< that turns
    int degrees = 3;                      ///< a frame
    int frames = 5;                       ///< the first of which is not counted
    std::vector<int> iterations{16, 64};  ///< a frame
};

/// [BSS05] section 6: frames that begin with the light of the one before, and frames that do not.
void follow_frames(const FramesSettings& settings, Report& report);

struct LayersSettings {
    Settings shared;
    int directions = 5000;
    std::vector<int> overdraws{1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20};  ///< planes in the stack
    std::vector<int> slabs{1, 2, 4};  ///< that divide the planes, or are left out
    int views = 4;                    ///< that the chance is taken from
    std::string folder;               ///< for the pictures; empty: none are made
};

/// [TN11] figures 2, 7 and 8: illumination maps, the chance that a surface is found, and the red
/// light that leaks where it is not.
void measure_layers(const LayersSettings& settings, Report& report);

struct LeakSettings {
    Settings shared;
    double leak = 0.01;                                   ///< the paper's
    std::vector<int> directions{50, 100, 200, 400, 800};  ///< before and after the light changes
};

/// [TN11] section 5: leaky integration beside the mean, and how it follows light that changes.
void follow_light(const LeakSettings& settings, Report& report);

struct DirectionsSettings {
    Settings shared;                  ///< the map's side is that of the lightmap
    int directions = 0;               ///< for each scene; 0: as many as the paper
    std::vector<std::string> scenes;  ///< keys of the table in directions.cpp; empty: all
    std::string sky;                  ///< file; empty: a clear sky
    std::string sponza;               ///< file of one more scene; empty: as of LUMEL_DATA
    std::string folder;               ///< for the picture; empty: none is made
    int width = 320;                  ///< of each scene's picture [pixels]
};

/// [TN11] figure 9: its scenes, and the time per direction.
void show_directions(const DirectionsSettings& settings, Report& report);

struct DynamicSettings {
    Settings shared;                  ///< the map's side is that of all but the low quality scene
    std::vector<std::string> scenes;  ///< keys of the table in moving.cpp; empty: all
    int low_size = 64;                ///< side of the low quality scene's map [texels]
    int low_hemicube = 32;            ///< and of its hemicubes [pixels]
    int low_shooters = 64;            ///< its patches send at most 1 / this of all light
    int degrees = 10;                 ///< that the box turns in a step
    double residual = LiveOptions{}.residual;  ///< to rest at
    int steps = 5;                             ///< after the first, whose median counts
    bool gathers = true;
    std::vector<int> pieces{14, 41};  ///< that edges are cut into, for more vertices; 1 is the rest
    std::string folder;               ///< for the pictures; empty: none are made
    int width = 256;                  ///< of a picture [pixels]
};

/// [Hoef13] tables 5.1 to 5.3, section 5.3.1 and figures 4.5.3, 4.5.4 and 5.2.1 to 5.2.5: error,
/// time, hemicubes and pictures of correcting a solution when something moves.
void follow_moves(const DynamicSettings& settings, Report& report);

/// Causes of the distance between `cross` and a solution from scratch, with the share of each.
void share_out_cross(const DynamicSettings& settings, Report& report);

struct DriftSettings {
    Settings shared;
    int degrees = 10;                          ///< that the box turns, there and back
    double residual = LiveOptions{}.residual;  ///< to rest at
    int moves = 100;
};

/// What many moves, or one far away and back, leave of the first solution.
void follow_drift(const DriftSettings& settings, Report& report);

struct MatrixSettings {
    Settings shared;
    std::vector<int> patches{2048};                 ///< n at most, one after the other
    int lights = 16;                                ///< states of light that errors are taken of
    std::vector<double> shares{0, 1, 2, 4, 8, 16};  ///< kept exactly [%]
    std::string forms;   ///< a part of the names of those to compare, without the other tables
    std::string folder;  ///< for pictures; empty: none are made
    int width = 256;     ///< of a picture of the scene [pixels]
};

/// [SF17] figures 1 to 5, 7 to 10, 12 and 13: distribution of form factors, error and bytes of
/// compressed matrices, pictures of the matrix and of what it lights.
void compare_matrix_forms(const MatrixSettings& settings, Report& report);

struct MatrixSpeedSettings {
    Settings shared;
    int patches = 2048;                    ///< n at most, of the scene
    std::vector<int> bounces{1, 2, 4, 8};  ///< of naive radiosity
    std::vector<int> growth;               ///< patches to compare codes at; empty: none
    int large = 8192;                      ///< rows of a matrix of random numbers; 0: none
    int repeats = 8;                       ///< timed at a stretch
};

/// [SF17] figure 11: time of one multiply against naive radiosity, bounce by bounce.
void time_matrices(const MatrixSpeedSettings& settings, Report& report);

}  // namespace lumel::bench
