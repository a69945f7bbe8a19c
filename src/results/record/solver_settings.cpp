#include "results/record/solver_settings.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "base/core/number.h"
#include "results/record/fields.h"

namespace lumel {
namespace {

constexpr Limits kShots{0.0, 1e15};

/// Options newer than the format: a report without them has the defaults.
constexpr std::string_view kNewerOptions[] = {"form", "shooters", "integration"};

bool is_newer(std::string_view option)
{
    return std::find(std::begin(kNewerOptions), std::end(kNewerOptions), option) !=
           std::end(kNewerOptions);
}

template <class Options, class Visit>
void each_limit(Options& options, const Visit& visit)
{
    visit("shots", options.max_shots, kShots);
    visit("seconds", options.max_seconds);
    visit("error", options.target_error);
    visit("dark_error", options.target_dark_error);
}

/// Limits newer than the format: a report without them had none.
template <class Options, class Visit>
void each_newer_limit(Options& options, const Visit& visit)
{
    visit("eye_error", options.target_quality.eye_error);
    visit("visible_noise", options.target_quality.visible_noise);
}

/// Numbers as numbers, names as strings.
Json json_of(const OptionInfo& option, const MethodOptions& method)
{
    const std::string text = get_option(method, option);
    const auto number = number_of(text);
    return option.is_number() && number ? Json(std::int64_t(*number)) : Json(text);
}

/// For set_option(), which rejects other types.
std::string text_of(const Json& value)
{
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

Json solver_settings(const SolverOptions& options)
{
    const MethodInfo& method = method_of(options.method);
    Json settings = {{"method", method.id}};
    const FieldWriter limits(settings["limits"]);
    each_limit(options, limits);
    each_newer_limit(options, limits);
    Json& own = settings["options"] = Json::object();
    for (const OptionInfo& option : method.options)
        own[option.name] = json_of(option, options.method);
    return settings;
}

SolverOptions solver_options_of(const JsonView& settings)
{
    SolverOptions options;
    std::string id;
    const FieldReader field(settings);
    field("method", id);
    try {
        options.method = method_of(id).defaults();
    } catch (const Error& error) {
        settings.get("method").fail(error.what());
    }
    const JsonView own = settings.get("options");
    for (const OptionInfo& option : method_of(id).options) {
        if (is_newer(option.name) && !own.find(option.name))
            continue;
        const JsonView value = own.get(option.name);
        if (!set_option(options.method, option, text_of(value.json())))
            value.fail("must be " + option.range());
    }
    const JsonView limits = settings.get("limits");
    const FieldReader limit(limits);
    each_limit(options, limit);
    each_newer_limit(options, [&](const char* name, double& value) {
        if (limits.find(name))
            limit(name, value);
    });
    return options;
}

}  // namespace lumel
