#pragma once
// The settings of a run of the benchmark, and the scene that they make.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "methods/methods.h"
#include "raster/shadow_maps/direct_light.h"

namespace lumel::bench {

/// A horizontal quad that shines down, for scenes without lights of their own.
struct Lamp {
    glm::vec3 centre;  ///< [m]
    glm::vec2 size;    ///< along x and z [m]
    float exitance;    ///< [lm/m²]
};

/// Competitors beside the methods.
inline constexpr std::string_view kPathTracer = "path", kIteratedGather = "prog";

struct Settings {
    std::string scene = "scenes/cornell-box.gltf";
    int size = 128;  ///< side of the atlas [texels]
    LightOptions lights;
    std::uint32_t sky_directions = DirectLightOptions{}.sky_directions;
    std::vector<float> lamp;  ///< x, y, z, width, depth, exitance of a Lamp; empty: none
    std::vector<float> box;   ///< centre and size [m] of one that is added; empty: none
    std::string reference;  ///< EXR made by `lumel reference` with the same atlas; empty: made here
    int reference_spp = 4096;    ///< 0: none, nothing is compared
    std::string save_reference;  ///< EXR to keep the reference in
    std::string references;      ///< how names of EXRs begin that keep a Truth; empty: none do
    /// Methods and competitors.
    std::vector<std::string> racers{"links", "stochastic", std::string(kPathTracer),
                                    std::string(kIteratedGather)};
    std::vector<std::uint64_t> shots{16,   32,   64,   128,   256,   512,  1024,
                                     2048, 4096, 8192, 16384, 32768, 65536};
    std::vector<int> spp{4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096};
    std::vector<double> targets{5.0, 2.0, 1.0};  ///< errors to race to [%]
    double seconds = 60.0;                       ///< processor time after which a method stops
    std::vector<int> growth;                     ///< atlas sides to time instead of racing
    std::vector<int> cuts;  ///< comparing projections instead: pieces of each triangle edge
    std::vector<std::string> edits;   ///< to time instead, of a scene that is kept lit: dim:lamp
    std::vector<std::string> follow;  ///< changes whose light is followed instead
    std::string moves;                ///< instead: a thing of which moves are timed
    bool casters = false;             ///< instead: rays per second of each caster
    std::string seams;                ///< instead: PNG of seams before and after
    std::vector<std::string> ranks;   ///< instead: reports of a bake by one process and by several
    double cores = 16.0;              ///< of each machine that --ranks predicts for
    std::vector<float> from;          ///< eye and what it looks at [m]; empty: the preview's view
    std::uint32_t edit_rays = 64;     ///< of a lumel of such a scene
    /// Solutions of 256 rays whose mean its light is compared with; 0: not.
    std::uint32_t edit_truth = 0;
    GivenMethod given;  ///< the method and its options
    std::string device;
    float near_radius = 0.0f;  ///< 0: as suits the solver
};

/// For one method, with what it reads of the options that were given. Throws Error{input} for
/// values that it does not take.
Settings settings_of(const Settings& settings, std::string_view method);

/// The first of the racers that is a method, else the default: the competitors take its options.
std::string first_method(const Settings& settings);

/// Throws Error{input} for racers that are not known or do not belong together, and for options
/// that none of them reads.
void check_racers(const Settings& settings);

/// Solves without an end of its own: figures say when.
inline SolverOptions solver_of(const Settings& settings)
{
    return {.method = settings.given.options(), .target_error = 0.0};
}

/// A method's options of what was given that it reads: figures compare several methods.
template <class Options>
Options options_of(const Settings& settings)
{
    MethodOptions method = Options{};
    for (const auto& [name, value] : settings.given.values)
        set_option(method, name, value);
    return std::get<Options>(method);
}

/// The scene with its lamp and box. Throws Error.
Scene scene_of(const Settings& settings);

/// The same, laid out in an atlas of side `size`. Throws Error.
SolveScene prepare(const Settings& settings, int size);

}  // namespace lumel::bench
