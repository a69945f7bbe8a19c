#include "methods/methods.h"

#include <algorithm>

#include "base/core/error.h"
#include "solve/shooting/lumel_arrays.h"
#include "solve/solver/solver.h"

namespace lumel {
namespace {

/// Emissive surfaces that are at least this share of all are met by enough directions.
constexpr float kMuchShines = 1.0f / 16.0f;

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
    for (const MethodInfo& method : methods())
        if (method.option(name))
            readers.push_back(&method);
    return readers;
}

/// Throws for an option that does nothing beside the others.
void check_used(const MethodInfo& method, const OptionInfo& option, const MethodOptions& options)
{
    if (option.with && get_option(options, *method.option(option.with)) != option.with_value)
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

const MethodInfo& method_of(std::string_view id)
{
    std::vector<const MethodInfo*> known;
    for (const MethodInfo& info : methods()) {
        if (id == info.id)
            return info;
        known.push_back(&info);
    }
    throw Error(ErrorKind::input, "--solver " + std::string(id),
                "no such method; there are: " + listed(known));
}

const MethodInfo& method_of(const MethodOptions& options)
{
    return *std::find_if(methods().begin(), methods().end(), [&](const MethodInfo& method) {
        return method.defaults().index() == options.index();
    });
}

std::vector<SharedOption> options_of_methods()
{
    std::vector<SharedOption> all;
    for (const MethodInfo& method : methods())
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
        const std::vector<const MethodInfo*> readers = readers_of(name);
        if (readers.empty())
            throw Error(ErrorKind::input, name, "is not an option of any method");
        if (!option)
            throw Error(ErrorKind::input, "--" + name,
                        "is not read by --solver " + std::string(id) + "; it belongs to --solver " +
                            listed(readers));
        if (!set_option(options, *option, value))
            throw Error(ErrorKind::input, "--" + name + " " + value,
                        "must be " + option->range() + " with the method " + std::string(id));
    }
    for (const auto& [name, value] : given)
        check_used(method, *method.option(name), options);
    return options;
}

void set_default_limits(SolverOptions& options)
{
    if (!method_of(options.method).states_dark_error) {
        options.target_error = SolverOptions{}.target_error;
        return;
    }
    options.target_error = 0.0;
    options.target_quality = kGood;
    options.max_shots = kDefaultRays;
}

void check_limits(const SolverOptions& options)
{
    const MethodInfo& method = method_of(options.method);
    if (method.states_dark_error)
        return;
    const std::string unknown = std::string("is not known to --solver ") + method.id;
    if (options.target_dark_error > 0.0)
        throw Error(ErrorKind::input, "--dark-error",
                    unknown + ", which does not state the error of dark places");
    if (options.target_quality.is_given())
        throw Error(ErrorKind::input, "--quality",
                    unknown + ", which does not state what is seen; use --error");
}

std::string get_option(const MethodOptions& method, const OptionInfo& option)
{
    return std::visit([&](const auto& own) { return option.get(&own); }, method);
}

bool set_option(MethodOptions& method, const OptionInfo& option, const std::string& value)
{
    return std::visit([&](auto& own) { return option.set(&own, value); }, method);
}

bool set_option(MethodOptions& method, std::string_view name, const std::string& value)
{
    const OptionInfo* option = method_of(method).option(name);
    return option && set_option(method, *option, value);
}

bool has_near_field(const MethodOptions& method)
{
    return method_of(method).near_radius > 0.0f && !is_papers(method);
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
