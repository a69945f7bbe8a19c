#include "methods/methods.h"

#include <algorithm>

#include "base/core/error.h"
#include "methods/directions/directions_radiosity.h"
#include "methods/option_tables.h"
#include "solve/shooting/lumel_arrays.h"
#include "solve/solver/solver.h"

namespace lumel {
namespace {

using namespace option_tables;

template <class Options>
MethodOptions defaults()
{
    return Options{};
}

/// Emissive surfaces that are at least this share of all are met by enough directions.
constexpr float kMuchShines = 1.0f / 16.0f;

std::unique_ptr<Solver> make_directions(const SolverInputs& in, const DirectionsOptions& own,
                                        double target_error)
{
    if (finds_emitted(own, in.lumels, in.known))
        return std::make_unique<DirectionsRadiosity>(in.device, *in.world, *in.host, in.lumels, own,
                                                     target_error, in.known, in.parts);
    return std::make_unique<GlobalDirections>(in.device, *in.world, in.lumels, own, in.known);
}

template <class Method, class Options>
std::unique_ptr<Solver> make(const SolverInputs& in, const SolverOptions& options)
{
    const auto& own = std::get<Options>(options.method);
    if constexpr (std::is_same_v<Method, LinkRadiosity>)
        return std::make_unique<Method>(in.device, *in.host, in.lumels, own, options.limits(),
                                        in.parts);
    else if constexpr (std::is_same_v<Method, GlossyIllumination>)
        return std::make_unique<Method>(in.device, *in.world, in.lumels, in.near, own, in.known,
                                        in.particles, in.first_emission);
    else if constexpr (std::is_same_v<Method, GlobalDirections>)
        return make_directions(in, own, options.target_error);
    else if constexpr (std::is_same_v<Method, GatherRadiosity>)
        return std::make_unique<Method>(in.device, *in.world, in.lumels, own, options.target_error);
    else if constexpr (std::is_same_v<Method, ProgressiveRadiosity>)
        return std::make_unique<Method>(in.device, *in.world, in.lumels, in.near, own);
    else if constexpr (std::is_same_v<Method, MatrixRadiosity>)
        return std::make_unique<Method>(in.device, *in.world, *in.host, in.lumels, in.near, own,
                                        options.target_error, in.known);
    else
        return std::make_unique<Method>(in.device, *in.world, in.lumels, in.near, own, in.known);
}

template <class Method, class Options>
std::uint64_t bytes_of(const SolveSize& size, const MethodOptions& options)
{
    return Method::device_bytes(size, std::get<Options>(options));
}

constexpr float kUsualRadius = NearFieldOptions{}.radius;
/// Glossy multiplies by the near field in every iteration, and what close pairs exchange loses its
/// lobes: few pairs are better.
constexpr float kGlossyRadius = 3.0f;
/// Patches shoot from few points, so more of what is close to them is found exactly.
constexpr float kPatchRadius = 6.0f;
/// Along global directions no pair is too close, nor is any to a hemicube of its own.
constexpr float kNoNearField = 0.0f;

constexpr MethodInfo kMethods[] = {
    {.id = "links",
     .title = "Gathering over links that are traced once",
     .paper = "",
     .shots = "rays per lumel",
     .advice = "the default: any scene with diffuse surfaces, buildings above all",
     .materials = MaterialModel::diffuse,
     .near_radius = kNoNearField,
     .near_surroundings = false,
     .on_device = false,
     .finds_lights = true,
     .states_dark_error = true,
     .can_keep_sources = false,
     .can_resume = true,
     .defaults = defaults<LinksOptions>,
     .options = kLinksOptions,
     .make = make<LinkRadiosity, LinksOptions>,
     .device_bytes = bytes_of<LinkRadiosity, LinksOptions>},
    {.id = "stochastic",
     .title = "Stochastic radiosity by perspective ray bundles",
     .paper = "[BJ04], [BSS05]",
     .shots = "shooters",
     .advice = "small rooms of diffuse surfaces; the method that the others are compared with",
     .materials = MaterialModel::diffuse,
     .near_radius = kUsualRadius,
     .near_surroundings = false,
     .on_device = true,
     .finds_lights = false,
     .states_dark_error = false,
     .can_keep_sources = false,
     .can_resume = false,
     .defaults = defaults<StochasticOptions>,
     .options = kStochasticOptions,
     .make = make<StochasticRadiosity, StochasticOptions>,
     .device_bytes = bytes_of<StochasticRadiosity, StochasticOptions>},
    {.id = "glossy",
     .title = "Stochastic glossy global illumination",
     .paper = "[BSS05], [NNS99]",
     .shots = "shooters",
     .advice = "light that metals and polished surfaces pass on; noisier than the default",
     .materials = MaterialModel::glossy,
     .near_radius = kGlossyRadius,
     .near_surroundings = false,
     .on_device = true,
     .finds_lights = false,
     .states_dark_error = false,
     .can_keep_sources = false,
     .can_resume = false,
     .defaults = defaults<GlossyOptions>,
     .options = kGlossyOptions,
     .make = make<GlossyIllumination, GlossyOptions>,
     .device_bytes = bytes_of<GlossyIllumination, GlossyOptions>},
    {.id = "directions",
     .title = "Global directions with stochastic depth buffering",
     .paper = "[TN11]",
     .shots = "directions",
     .advice = "open scenes of diffuse surfaces under a sky",
     .materials = MaterialModel::diffuse,
     .near_radius = kNoNearField,
     .near_surroundings = false,
     .on_device = true,
     .finds_lights = false,
     .states_dark_error = false,
     .can_keep_sources = false,
     .can_resume = false,
     .defaults = defaults<DirectionsOptions>,
     .options = kDirectionsOptions,
     .make = make<GlobalDirections, DirectionsOptions>,
     .device_bytes = bytes_of<GlobalDirections, DirectionsOptions>},
    {.id = "progressive",
     .title = "Progressive refinement radiosity",
     .paper = "[CCWG88], [Hoef13]",
     .shots = "shooters",
     .advice =
         "small scenes of diffuse surfaces; the basis of animation, corrected when objects move",
     .materials = MaterialModel::diffuse,
     .near_radius = kPatchRadius,
     .near_surroundings = false,
     .on_device = true,
     .finds_lights = false,
     .states_dark_error = false,
     .can_keep_sources = false,
     .can_resume = false,
     .defaults = defaults<ProgressiveOptions>,
     .options = kProgressiveOptions,
     .make = make<ProgressiveRadiosity, ProgressiveOptions>,
     .device_bytes = bytes_of<ProgressiveRadiosity, ProgressiveOptions>},
    {.id = "gather",
     .title = "Gather radiosity by hemicubes on every lumel",
     .paper = "[CG85], [Hoef13]",
     .shots = "hemicubes",
     .advice = "an independent reference for the others; slow, --hemicube 64 is enough",
     .materials = MaterialModel::diffuse,
     .near_radius = kNoNearField,
     .near_surroundings = false,
     .on_device = true,
     .finds_lights = false,
     .states_dark_error = false,
     .can_keep_sources = false,
     .can_resume = false,
     .defaults = defaults<GatherOptions>,
     .options = kGatherOptions,
     .make = make<GatherRadiosity, GatherOptions>,
     .device_bytes = bytes_of<GatherRadiosity, GatherOptions>},
    {.id = "matrix",
     .title = "Form-factor matrices of all reflections",
     .paper = "[SF17]",
     .shots = "rays per lumel",
     .advice = "one scene under many lights: lumel relight takes milliseconds; small indirect "
               "detail is lost",
     .materials = MaterialModel::diffuse,
     .near_radius = kPatchRadius,
     .near_surroundings = true,
     .on_device = true,
     .finds_lights = false,
     .states_dark_error = false,
     .can_keep_sources = true,
     .can_resume = false,
     .defaults = defaults<MatrixOptions>,
     .options = kMatrixOptions,
     .make = make<MatrixRadiosity, MatrixOptions>,
     .device_bytes = bytes_of<MatrixRadiosity, MatrixOptions>},
};
static_assert(std::size(kMethods) == std::variant_size_v<MethodOptions>);

std::string listed(const std::vector<const MethodInfo*>& methods)
{
    std::string list;
    for (const MethodInfo* method : methods)
        list += (list.empty() ? "" : ", ") + std::string(method->id);
    return list;
}

/// The methods that read an option.
std::vector<const MethodInfo*> readers_of(std::string_view name)
{
    std::vector<const MethodInfo*> readers;
    for (const MethodInfo& method : kMethods)
        if (method.option(name))
            readers.push_back(&method);
    return readers;
}

/// Throws for an option that does nothing beside the others.
void check_used(const MethodInfo& method, const OptionInfo& option, const MethodOptions& options)
{
    if (option.with && method.option(option.with)->get(options) != option.with_value)
        throw Error(ErrorKind::input, std::string("--") + option.name,
                    std::string("does nothing without --") + option.with + " " + option.with_value);
}

}  // namespace

const OptionInfo* MethodInfo::option(std::string_view name) const
{
    for (const OptionInfo& info : options)
        if (name == info.name)
            return &info;
    return nullptr;
}

std::span<const MethodInfo> methods()
{
    return kMethods;
}

const MethodInfo& method_of(std::string_view id)
{
    std::vector<const MethodInfo*> known;
    for (const MethodInfo& info : kMethods) {
        if (id == info.id)
            return info;
        known.push_back(&info);
    }
    throw Error(ErrorKind::input, "--solver " + std::string(id),
                "no such method; there are: " + listed(known));
}

const MethodInfo& method_of(const MethodOptions& options)
{
    return *std::find_if(std::begin(kMethods), std::end(kMethods), [&](const MethodInfo& method) {
        return method.defaults().index() == options.index();
    });
}

std::vector<SharedOption> options_of_methods()
{
    std::vector<SharedOption> all;
    for (const MethodInfo& method : kMethods)
        for (const OptionInfo& option : method.options)
            if (std::none_of(all.begin(), all.end(), [&](const SharedOption& known) {
                    return std::string_view(known.info->name) == option.name;
                }))
                all.push_back({&option, readers_of(option.name)});
    return all;
}

MethodOptions method_options(std::string_view id, const std::map<std::string, std::string>& given)
{
    const MethodInfo& method = method_of(id);
    MethodOptions options = method.defaults();
    for (const auto& [name, value] : given) {
        const OptionInfo* option = method.option(name);
        if (!option)
            throw Error(ErrorKind::input, "--" + name,
                        "is not read by --solver " + std::string(id) + "; it belongs to --solver " +
                            listed(readers_of(name)));
        if (!option->set(options, value))
            throw Error(ErrorKind::input, "--" + name + " " + value,
                        "must be " + option->range() + " with the method " + std::string(id));
    }
    for (const auto& [name, value] : given)
        check_used(method, *method.option(name), options);
    return options;
}

void check_limits(const SolverOptions& options)
{
    const MethodInfo& method = method_of(options.method);
    if (options.target_dark_error > 0.0 && !method.states_dark_error)
        throw Error(ErrorKind::input, "--dark-error",
                    std::string("is not known to --solver ") + method.id +
                        ", which does not state the error of dark places");
}

bool set_option(MethodOptions& method, std::string_view name, const std::string& value)
{
    const OptionInfo* option = method_of(method).option(name);
    return option && option->set(method, value);
}

bool has_near_field(const MethodOptions& method)
{
    return method_of(method).near_radius > kNoNearField && !is_papers(method);
}

bool finds_emitted(const MethodOptions& method, const Lumels& lumels,
                   std::span<const glm::vec3> known)
{
    const auto* directions = std::get_if<DirectionsOptions>(&method);
    return directions && directions->iteration.scheme == Scheme::phased &&
           emissive_share(lumels, known) < kMuchShines;
}

bool gathers_sky(const MethodOptions& method)
{
    const auto* directions = std::get_if<DirectionsOptions>(&method);
    return directions && directions->iteration.scheme == Scheme::paper && directions->sky;
}

NearFieldOptions near_field_options(const SolverOptions& options)
{
    // The table's noise does not fall with the number of shots, so its samples follow the target.
    // The default serves 2 %; how much of an error is the table's was not measured alone.
    constexpr int kSamples = 16, kMaxSamples = 144;
    constexpr double kTarget = 0.02, kUsualShots = 2048.0;
    double finer = 1.0;
    if (options.target_error > 0.0)
        finer = kTarget / options.target_error;
    else if (options.max_shots > 0)
        finer = double(options.max_shots) / kUsualShots;
    const MethodInfo& method = method_of(options.method);
    NearFieldOptions near;
    near.samples = int(std::clamp(kSamples * finer, double(kSamples), double(kMaxSamples)));
    near.centre = rule_of(options.method) == SampleRule::centre;
    near.seed = seed_of(options.method);
    near.radius = method.near_radius;
    near.surroundings = method.near_surroundings;
    return near;
}

NearField near_field_for(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                         const SolverOptions& options, float radius)
{
    if (!has_near_field(options.method))
        return {};
    NearFieldOptions near = near_field_options(options);
    if (radius > 0.0f)
        near.radius = radius;
    return build_near_field(scene, rays, lumels, near);
}

std::uint64_t near_pairs_for(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                             const SolverOptions& options)
{
    return has_near_field(options.method)
               ? count_near_pairs(scene, rays, lumels, near_field_options(options))
               : 0;
}

std::uint64_t solver_bytes(const SolveSize& size, const SolverOptions& options)
{
    return method_of(options.method).device_bytes(size, options.method);
}

std::unique_ptr<Solver> make_solver(const SolverInputs& inputs, const SolverOptions& options)
{
    return method_of(options.method).make(inputs, options);
}

}  // namespace lumel
