#include "results/measure/arriving_light.h"

#include "atlas/lumels/sides.h"
#include "atlas/prepare/lit_sides.h"
#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "lights/shadow_rays.h"

namespace lumel {
namespace {

/// A back with less light than this fraction of its front's is unlit.
constexpr double kDark = 0.01;

std::vector<glm::vec3> reflected_by(const Lumels& lumels, std::span<const glm::vec3> irradiance)
{
    std::vector<glm::vec3> reflected;
    reflected.reserve(irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        reflected.push_back(lumel.flags & kLumelBuried ? glm::vec3(0.0f)
                                                       : lumel.albedo * irradiance[i]);
    }
    return reflected;
}

/// [N] 1: buried lumel, or one of an unlit back. The map of such a chart shows the front, and the
/// back receives next to nothing: little light enters a closed solid, through lumels that cross its
/// edges.
std::vector<char> dark_lumels(const Atlas& atlas, const Lumels& lumels,
                              std::span<const glm::vec3> irradiance)
{
    struct Light {
        double side[2] = {0.0, 0.0};  // front, back [lm]
    };
    std::vector<Light> of_charts(atlas.chart_count);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        of_charts[lumel.chart].side[is_back(lumel) ? 1 : 0] +=
            luminance(irradiance[i]) * double(lumel.area);
    }
    std::vector<char> dark;
    dark.reserve(irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        const Light& light = of_charts[lumel.chart];
        const bool is_unlit = is_back(lumel) && !has_own_back(atlas.back_shift, lumel.chart) &&
                              light.side[1] < kDark * light.side[0];
        dark.push_back(is_unlit || (lumel.flags & kLumelBuried));
    }
    return dark;
}

}  // namespace

ArrivingLight::ArrivingLight(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                             const Lumels& lumels, std::span<const glm::vec3> irradiance)
    : rays_(rays),
      surfaces_(scene),
      sources_(scene, surfaces_, glm::distance(rays.low(), rays.high())),
      hits_(scene, atlas, lumels),
      reflected_(reflected_by(lumels, irradiance)),
      dark_(dark_lumels(atlas, lumels, irradiance)),
      atlas_(atlas),
      inner_(find_inner_sides(scene, rays, atlas)),
      first_surface_(first_surfaces(atlas, scene.instances.size()))
{
}

bool ArrivingLight::is_inner(const RayHit& hit) const
{
    const Surface& surface = atlas_.surfaces[first_surface_[hit.instance] + hit.primitive];
    return inner_[surface.chart[hit.triangle]][hit.front ? 0 : 1];
}

MetLight ArrivingLight::met_along(const glm::vec3& position, const glm::vec3& direction,
                                  std::uint32_t seed, std::uint32_t& backs) const
{
    RayHit hit;
    if (!rays_.closest(ray_out(position, direction, seed), hit))
        return {.light = kPi * hit.tint * sources_.dim_sky(direction),
                .is_sky = true,
                .tint = hit.tint};
    if (!hit.front && !surfaces_.all()[surfaces_.index(hit.instance, hit.primitive)].double_sided) {
        ++backs;
        return {};
    }
    const std::uint32_t lumel = hits_.lumel(hit);
    if (is_inner(hit) || (lumel != HitLumels::kNone && dark_[lumel]))
        ++backs;
    if (lumel == HitLumels::kNone)
        return {};
    return {.light = hit.tint * reflected_[lumel], .lumel = lumel, .tint = hit.tint};
}

glm::vec3 ArrivingLight::transmittance(const RayOrigin& start, const SourceSample& sample,
                                       std::uint32_t seed) const
{
    return transmittance_to(rays_, sample, start, seed);
}

}  // namespace lumel
