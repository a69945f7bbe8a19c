#pragma once
// What every method offers, and the one table of methods.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/sample_rule.h"
#include "gpu/pacer.h"
#include "lobes/lobes.shared.h"
#include "nearfield/near_field.h"
#include "shooting/iteration.h"
#include "shooting/solver_state.h"
#include "solve/gather.shared.h"
#include "solve/glossy.shared.h"
#include "solve/progressive.shared.h"
#include "solve/stochastic.shared.h"
#include "transport/transport.h"
#include "visibility/illumination_maps.h"
#include "visibility/view_options.h"
#include "world/world.h"

namespace lumel {

class LobeParticles;

/// Of "matrix": its three matrices of n × n numbers and their inverse have to fit into memory, and
/// take n³ operations.
inline constexpr std::uint32_t kFewestPatches = 8, kMostPatches = 16384;
inline constexpr std::uint32_t kMostBounces = 1'000'000;

/// Of "directions": a direction has twice as many maps.
inline constexpr std::uint32_t kMostSlabs = 64;

struct SolverOptions {
    std::string method = "stochastic";  ///< id in kMethods
    Scheme scheme = Scheme::phased;
    SampleRule rule = SampleRule::area;
    bool disc = true;  ///< of "stochastic" with Scheme::paper: shooters are discs, [BSS05] Eq. (8)
    /// Of "stochastic" with Scheme::paper: squares of 2^merge texels a side shoot as one, as far as
    /// they belong to one chart, [BSS05] section 5. 0: each texel alone.
    std::uint32_t merge = 0;
    std::uint32_t seed = 1;
    int batch = 16;  ///< K, shooters per iteration, 1 to MethodInfo::most_batch
    Projection projection = Projection::hemicube;
    int hemicube = 256;            ///< side of the front face [pixels], see EyeViews
    Layers layers = Layers::list;  ///< of illumination maps
    int lookups = 3;               ///< with Layers::stochastic: 1, 3 or 5 pixels wide and high
    /// With Layers::stochastic: that a direction is cut into, 1 to kMostSlabs; 0: as many as the
    /// overdraw asks for, see IlluminationMaps.
    std::uint32_t slabs = 0;
    int map_side = 0;  ///< of an illumination map [pixels], 0: as suits the lumels
    bool sky = true;   ///< of "directions" with Scheme::paper: gathers the world's sky
    /// Of "stochastic" and "directions" with Scheme::paper: the part of the solution that each shot
    /// replaces, [TN11] section 5 (0.01), so that light that changes is followed. 0: the mean of
    /// all shots, which converges.
    double leak = 0.0;
    std::uint32_t patches = 2048;  ///< of "matrix": n at most
    std::uint32_t bounces = 0;     ///< of "matrix": k, reflections that count, 0: all
    std::uint64_t max_shots = 0;   ///< 0: no limit
    double max_seconds = 0.0;      ///< of solving, 0: no limit
    double target_error = 0.02;    ///< estimated relative error to stop at, 0: never
};

/// How its shooters see. Throws Error{input} as checked_batch() does.
ViewOptions view_options(const SolverOptions& options);
IterationOptions iteration_options(const SolverOptions& options);
TransportOptions transport_options(const SolverOptions& options);

/// A method at work on one world. Every method fills the same result.
class Solver {
public:
    virtual ~Solver() = default;

    /// One pass of the paper's outer loop, recorded and submitted.
    virtual void step() = 0;
    virtual SolverState state() const = 0;
    /// H [N] [lx] of the solution so far. Waits for the device.
    virtual std::vector<glm::vec3> irradiance() = 0;
    /// Device time per stage [ms] so far.
    virtual const gpu::StageTimes& times() const = 0;
    /// Longest submission so far [ms].
    virtual double longest_submission() const = 0;
};

/// A method of the table: what --solver takes.
struct MethodInfo {
    const char* id;
    const char* title;
    const char* paper;                                 ///< keys of docs/references.md
    const char* advice;                                ///< when to use it
    MaterialModel materials = MaterialModel::diffuse;  ///< what it reads of them
    float near_radius = NearFieldOptions{}.radius;     ///< NearFieldOptions::radius that suits it
    std::uint32_t most_batch = kMostBatch;             ///< K at most
};

inline constexpr MethodInfo kMethods[] = {
    {"stochastic", "Stochastic radiosity by perspective ray bundles", "[BJ04], [BSS05]",
     "the default: any scene with diffuse surfaces and emissive lights"},
    {"glossy", "Stochastic glossy global illumination", "[BSS05], [NNS99]",
     "light that metals and polished surfaces pass on; noisier than the default",
     // It multiplies by the near field in every iteration, and what close pairs exchange loses its
     // lobes: few pairs are better.
     MaterialModel::glossy, 3.0f, kMostGlossyBatch},
    {"directions", "Global directions with stochastic depth buffering", "[TN11]",
     "open scenes of diffuse surfaces with few small emissive lights"},
    {"progressive", "Progressive refinement radiosity", "[CCWG88], [Hoef13]",
     "small scenes of diffuse surfaces; what is corrected when things move", MaterialModel::diffuse,
     6.0f, kMostPatchBatch},
    {"gather", "Gather radiosity by hemicubes on every lumel", "[CG85], [Hoef13]",
     "a reference for the others, which shares nothing with them: slow; --hemicube 64 is enough",
     MaterialModel::diffuse, NearFieldOptions{}.radius, kMostHemicubes},
    {"matrix", "Form-factor matrices of all reflections", "[SF17]",
     "one scene under many lights: lumel relight answers at once; small indirect detail is lost",
     MaterialModel::diffuse, 6.0f, kMostPatchBatch},
};

/// The method of that name. Throws Error{input} if there is none.
const MethodInfo& method_of(const std::string& id);

/// The batch as K of that method. Throws Error{input} if it is not from 1 to most_batch.
std::uint32_t checked_batch(const MethodInfo& method, int batch);

/// Does the solver find the sky's light itself, so that it is not to be among the emission?
bool gathers_sky(const SolverOptions& options);

/// The near field that suits the options: finer where a smaller error is asked for.
NearFieldOptions near_field_options(const SolverOptions& options);

/// Builds it; empty for methods and schemes without a near field. radius:
/// NearFieldOptions::radius; 0: as suits the method.
NearField near_field_for(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                         const SolverOptions& options, float radius = 0.0f);

/// Throws Error{input} if options.method is not in the table or cannot take options.batch. `near`
/// may be empty for methods and schemes without a near field. `known`: H [N] [lx] that lumels
/// receive beside what the solver finds, or empty: the error it states is a part of both, but the
/// noise of what is known is not in it. particles: see GlossyIllumination.
std::unique_ptr<Solver> make_solver(const gpu::Device& device, const World& world,
                                    const Lumels& lumels, const NearField& near,
                                    const SolverOptions& options,
                                    std::span<const glm::vec3> known = {},
                                    const LobeParticles* particles = nullptr);

/// Steps until a limit of the options is met or `go_on` returns false. Returns true unless
/// go_on ended it.
bool solve(Solver& solver, const SolverOptions& options,
           const std::function<bool(const SolverState&)>& go_on = {});

}  // namespace lumel
