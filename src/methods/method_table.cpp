// The table of methods.

#include <iterator>

#include "links/trace/links.h"
#include "links/trace/links_option_table.h"
#include "methods/directions/directions_radiosity.h"
#include "methods/directions/option_table.h"
#include "methods/gather/gather.h"
#include "methods/gather/option_table.h"
#include "methods/glossy/glossy.h"
#include "methods/glossy/option_table.h"
#include "methods/matrix/matrix.h"
#include "methods/matrix/option_table.h"
#include "methods/methods.h"
#include "methods/progressive/option_table.h"
#include "methods/progressive/progressive.h"
#include "methods/stochastic/option_table.h"
#include "methods/stochastic/stochastic.h"

namespace lumel {
namespace {

// The solver of each method.

std::unique_ptr<Solver> create(const SolverInputs& in, const SolveLimits& limits,
                               const LinksOptions& own)
{
    return std::make_unique<LinkRadiosity>(in.device, *in.scene, own, limits, in.parts, in.ranks);
}

std::unique_ptr<Solver> create(const SolverInputs& in, const SolveLimits&,
                               const StochasticOptions& own)
{
    return std::make_unique<StochasticRadiosity>(*in.device, *in.world, in.lumels, in.near, own,
                                                 in.known);
}

std::unique_ptr<Solver> create(const SolverInputs& in, const SolveLimits&, const GlossyOptions& own)
{
    return std::make_unique<GlossyIllumination>(*in.device, *in.world, in.lumels, in.near, own,
                                                in.known, in.particles, in.first_emission);
}

std::unique_ptr<Solver> create(const SolverInputs& in, const SolveLimits& limits,
                               const DirectionsOptions& own)
{
    if (finds_emitted(own, in.lumels, in.known))
        return std::make_unique<DirectionsRadiosity>(*in.device, *in.world, *in.scene, in.lumels,
                                                     own, limits.target_error, in.known, in.parts);
    return std::make_unique<GlobalDirections>(*in.device, *in.world, in.lumels, own, in.known);
}

std::unique_ptr<Solver> create(const SolverInputs& in, const SolveLimits&,
                               const ProgressiveOptions& own)
{
    return std::make_unique<ProgressiveRadiosity>(*in.device, *in.world, in.lumels, in.near, own);
}

std::unique_ptr<Solver> create(const SolverInputs& in, const SolveLimits& limits,
                               const GatherOptions& own)
{
    return std::make_unique<GatherRadiosity>(*in.device, *in.world, in.lumels, own,
                                             limits.target_error);
}

std::unique_ptr<Solver> create(const SolverInputs& in, const SolveLimits& limits,
                               const MatrixOptions& own)
{
    return std::make_unique<MatrixRadiosity>(*in.device, *in.world, *in.scene, in.lumels, in.near,
                                             own, limits.target_error, in.known);
}

/// An entry of the table, completed by the types of its solver and of its options.
template <class Method, class Options>
constexpr MethodInfo entry(MethodInfo info)
{
    info.defaults = []() -> MethodOptions { return Options{}; };
    info.make = [](const SolverInputs& inputs, const SolverOptions& options) {
        return create(inputs, options.limits(), std::get<Options>(options.method));
    };
    info.device_bytes = [](const SolveSize& size, const MethodOptions& options) {
        return Method::device_bytes(size, std::get<Options>(options));
    };
    return info;
}

/// Glossy multiplies by the near field in every iteration, and what close pairs exchange loses its
/// lobes: few pairs are better.
constexpr float kGlossyRadius = 3.0f;
/// Patches shoot from few points, so more of what is close to them is found exactly.
constexpr float kPatchRadius = 6.0f;

// Without a near field: along global directions no pair is too close, nor is any to a hemicube or
// to rays of its own.
constexpr MethodInfo kMethods[] = {
    entry<LinkRadiosity, LinksOptions>(
        {.id = "links",
         .title = "Gathering over links, traced once",
         .shots = "rays per lumel",
         .advice = "the default: any scene with diffuse surfaces, especially buildings",
         .on_device = false,
         .finds_lights = true,
         .states_dark_error = true,
         .can_resume = true,
         .options = kLinksOptions}),
    entry<StochasticRadiosity, StochasticOptions>(
        {.id = "stochastic",
         .title = "Stochastic radiosity by perspective ray bundles",
         .paper = "[BJ04], [BSS05]",
         .shots = "shooters",
         .advice = "small diffuse rooms; the method that the others are compared with",
         .near_radius = NearFieldOptions{}.radius,
         .options = kStochasticOptions}),
    entry<GlossyIllumination, GlossyOptions>(
        {.id = "glossy",
         .title = "Stochastic glossy global illumination",
         .paper = "[BSS05], [NNS99]",
         .shots = "shooters",
         .advice = "light reflected by metals and polished surfaces; noisier than the default",
         .materials = MaterialModel::glossy,
         .near_radius = kGlossyRadius,
         .options = kGlossyOptions}),
    entry<GlobalDirections, DirectionsOptions>(
        {.id = "directions",
         .title = "Global directions with stochastic depth buffering",
         .paper = "[TN11]",
         .shots = "directions",
         .advice = "open diffuse scenes under a sky",
         .options = kDirectionsOptions}),
    entry<ProgressiveRadiosity, ProgressiveOptions>(
        {.id = "progressive",
         .title = "Progressive refinement radiosity",
         .paper = "[CCWG88], [Hoef13]",
         .shots = "shooters",
         .advice = "small diffuse scenes; the basis of animation, corrected when objects move",
         .near_radius = kPatchRadius,
         .options = kProgressiveOptions}),
    entry<GatherRadiosity, GatherOptions>(
        {.id = "gather",
         .title = "Gather radiosity by hemicubes on every lumel",
         .paper = "[CG85], [Hoef13]",
         .shots = "hemicubes",
         .advice = "an independent reference for the others; slow",
         .options = kGatherOptions}),
    entry<MatrixRadiosity, MatrixOptions>(
        {.id = "matrix",
         .title = "Form-factor matrices of all reflections",
         .paper = "[SF17]",
         .shots = "rays per lumel",
         .advice = "one scene under many lights: lumel relight takes milliseconds; small indirect "
                   "details are lost",
         .near_radius = kPatchRadius,
         .near_surroundings = true,
         .can_keep_sources = true,
         .options = kMatrixOptions}),
};
static_assert(std::size(kMethods) == std::variant_size_v<MethodOptions>);

}  // namespace

std::span<const MethodInfo> methods()
{
    return kMethods;
}

}  // namespace lumel
