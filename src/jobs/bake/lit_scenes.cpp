#include "jobs/bake/lit_scenes.h"

#include <algorithm>
#include <numbers>

#include "atlas/finish/fine_radiance.h"
#include "base/images/image_files.h"

namespace lumel {

std::vector<glm::vec3> radiance_of(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    std::vector<glm::vec3> radiance;
    radiance.reserve(irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        radiance.push_back((lumel.albedo * irradiance[i] + lumel.emission) *
                           std::numbers::inv_pi_v<float>);
    }
    return radiance;
}

float exposure_of(const Image& radiance)
{
    return choose_exposure(radiance).value_or(1.0f);
}

std::optional<AddedCamera> camera_for(const SolveScene& prepared, const std::optional<View>& view)
{
    if (!view || !prepared.scene.cameras.empty())
        return std::nullopt;
    return AddedCamera{.view = *view, .extent = prepared.extent()};
}

BakedTexture baked_texture(const SolveScene& prepared, const Image& map, const Image& radiance,
                           int most)
{
    const int wanted = texture_density(prepared.scene, prepared.atlas);
    const int scale = std::clamp(most / prepared.atlas.pages.side, 1, wanted);
    return {scale == 1 ? radiance
                       : fine_radiance(prepared.scene, prepared.atlas, map, radiance, scale),
            double(scale) / double(wanted)};
}

}  // namespace lumel
