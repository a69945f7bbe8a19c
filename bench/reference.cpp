#include "bench/reference.h"

#include <cstdio>

#include <fmt/core.h>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "truth/reference.h"

namespace lumel::bench {
namespace {

constexpr std::uint32_t kSeed = 99;  ///< of paths; no solver's default

}  // namespace

std::optional<Image> reference_map(const Settings& settings, const SolveScene& world,
                                   std::uint32_t half)
{
    if (!settings.reference.empty())
        return read_exr(settings.reference);
    if (settings.reference_spp <= 0)
        return {};
    fmt::print("reference: path tracing {} samples per lumel …\n", settings.reference_spp);
    std::fflush(stdout);
    const Image map = finish_map(world.scene, world.atlas, world.lumels,
                                 reference_irradiance(world.scene, world.rays, world.lumels,
                                                      {.samples_per_lumel = settings.reference_spp,
                                                       .seed = kSeed + half,
                                                       .rule = rule_of(settings.given.options())}));
    if (!settings.save_reference.empty() && half == 0)
        write_exr(settings.save_reference, map, Precision::float32, {});
    return map;
}

}  // namespace lumel::bench
