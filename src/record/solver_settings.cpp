#include "record/solver_settings.h"

#include <limits>

#include "record/fields.h"

namespace lumel {
namespace {

constexpr Limits kSeeds{0.0, double(std::numeric_limits<std::uint32_t>::max())};
constexpr Limits kShots{0.0, 1e15};
constexpr Limits kBatches{1.0, 65536.0};
constexpr Limits kHemicubes{1.0, 65536.0};  // sides [pixels]
constexpr Limits kShares{0.0, 1.0};

template <class Options, class Visit>
void each_limit(Options& options, const Visit& visit)
{
    visit("shots", options.max_shots, kShots);
    visit("seconds", options.max_seconds);
    visit("error", options.target_error);
}

template <class Options, class Visit>
void each_option(Options& options, const Visit& visit)
{
    visit("scheme", options.scheme);
    visit("sampling", options.rule);
    visit("batch", options.batch, kBatches);
    visit("projection", options.projection);
    visit("hemicube", options.hemicube, kHemicubes);
    visit("disc", options.disc);
    visit("merge", options.merge);
    visit("leak", options.leak, kShares);
    visit("sky", options.sky);
    visit("layers", options.layers);
    visit("lookups", options.lookups);
    visit("slabs", options.slabs, Limits{0.0, double(kMostSlabs)});
    visit("map-side", options.map_side);
    visit("patches", options.patches, Limits{0.0, double(kMostPatches)});
    visit("bounces", options.bounces, Limits{0.0, double(kMostBounces)});
}

}  // namespace

Json solver_settings(const SolverOptions& options)
{
    Json settings = {{"method", options.method}, {"seed", options.seed}};
    each_limit(options, FieldWriter(settings["limits"]));
    each_option(options, FieldWriter(settings["options"]));
    return settings;
}

SolverOptions solver_options_of(const JsonView& settings)
{
    SolverOptions options;
    const FieldReader field(settings);
    field("method", options.method);
    try {
        method_of(options.method);
    } catch (const Error& error) {
        settings.get("method").fail(error.what());
    }
    field("seed", options.seed, kSeeds);
    each_limit(options, FieldReader(settings.get("limits")));
    each_option(options, FieldReader(settings.get("options")));
    return options;
}

}  // namespace lumel
