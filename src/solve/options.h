#pragma once
// The options of each method: a small struct per method, of which one is chosen.

#include <cstdint>
#include <variant>

#include "atlas/sample_rule.h"
#include "shooting/iteration.h"
#include "transport/transport.h"
#include "visibility/illumination_maps.h"
#include "visibility/view_options.h"

namespace lumel {

/// Who casts rays.
enum class Rays {
    automatic,  ///< a device that is no CPU, by queries or else by raster; or the host
    host,
    query,   ///< the device's ray queries
    raster,  ///< drawings by the device, for rays that leave lumels; others go to the host
};

struct LinksOptions {
    std::uint32_t seed = 1;
    SampleRule rule = SampleRule::area;
    bool filter = true;  ///< averages lumels with others of their chart that look alike
    Rays rays = Rays::automatic;
    /// Lumels share directions with those so many texels off, in 16 sets for 4. 0: every lumel has
    /// its own, but for Rays::raster, which takes kInterleaved.
    std::uint32_t interleaved = 0;
};

inline constexpr std::uint32_t kInterleaved = 4;

struct StochasticOptions {
    std::uint32_t seed = 1;
    ViewOptions views;
    SampleRule rule = SampleRule::area;
    IterationOptions iteration;
    bool disc = true;  ///< with Scheme::paper: shooters are discs, [BSS05] Eq. (8)
    /// With Scheme::paper: squares of 2^merge texels a side shoot as one, as far as they belong to
    /// one chart, [BSS05] section 5. 0: each texel alone.
    std::uint32_t merge = 0;
};

struct GlossyOptions {
    std::uint32_t seed = 1;
    ViewOptions views;
    SampleRule rule = SampleRule::area;  ///< of receivers
    Scheme scheme = Scheme::phased;
    /// With Scheme::paper: squares of 2^merge texels a side shoot as one from their common centre,
    /// as far as they belong to one chart, [BSS05] section 5. 0: each texel alone.
    std::uint32_t merge = 1;
    /// With Scheme::paper: a tenth of the shooters is drawn by area alone, and all are weighted
    /// [VG95]; else all are drawn by power.
    bool two_choices = true;
};

struct DirectionsOptions {
    std::uint32_t seed = 1;
    int batch = 16;  ///< K, directions at a time
    SampleRule rule = SampleRule::area;
    IterationOptions iteration;
    Layers layers = Layers::list;  ///< of illumination maps
    int lookups = 3;               ///< with Layers::stochastic: 1, 3 or 5 pixels wide and high
    /// With Layers::stochastic: slabs that a direction is cut into; 0: as many as the overdraw
    /// requires, see IlluminationMaps.
    std::uint32_t slabs = 0;
    int map_side = 0;  ///< of an illumination map [pixels], 0: as suits the lumels
    bool sky = true;   ///< with Scheme::paper: gathers the world's sky
};

struct ProgressiveOptions {
    std::uint32_t seed = 1;  ///< of the near field: patches shoot from fixed points
    ViewOptions views;
};

struct GatherOptions {
    std::uint32_t seed = 1;
    int batch = 16;      ///< K, hemicubes at a time
    int hemicube = 256;  ///< side of the front face [pixels], see EyeViews
    SampleRule rule = SampleRule::area;
};

struct MatrixOptions {
    std::uint32_t seed = 1;
    TransportOptions transport;
};

using MethodOptions =
    std::variant<LinksOptions, StochasticOptions, GlossyOptions, DirectionsOptions,
                 ProgressiveOptions, GatherOptions, MatrixOptions>;

/// A method, and when to stop.
struct SolverOptions {
    MethodOptions method = LinksOptions{};
    std::uint64_t max_shots = 0;     ///< 0: no limit
    double max_seconds = 0.0;        ///< 0: no limit. Of a bake: from its beginning
    double target_error = 0.02;      ///< estimated relative error to stop at, 0: never
    double target_dark_error = 0.0;  ///< the same of dark lumels, see SolverState, 0: never
    std::uint64_t max_bytes = 0;     ///< of the host that links may take, 0: no limit
};

// What most methods have, and what stands for it in the others.

inline std::uint32_t seed_of(const MethodOptions& method)
{
    return std::visit([](const auto& options) { return options.seed; }, method);
}

/// SampleRule::area of methods that have no other.
SampleRule rule_of(const MethodOptions& method);

/// The default of methods that do not look from eyes.
ViewOptions views_of(const MethodOptions& method);

/// K, shooters of one step; 0 of methods without shooters.
int batch_of(const MethodOptions& method);

/// True for the papers' iteration, which has no near field.
bool is_papers(const MethodOptions& method);

}  // namespace lumel
