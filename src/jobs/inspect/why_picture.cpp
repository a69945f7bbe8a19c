#include "jobs/inspect/why_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atlas/finish/finish.h"
#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "results/preview/preview.h"

namespace lumel {
namespace {

/// Brightness of surfaces that contribute nothing, relative to the lit scene.
constexpr float kDim = 0.4f;
/// Exponent of the colour scale: a hundredth of the maximum is shown at a quarter, so that walls
/// beside a lamp are visible.
constexpr float kHeatPower = 0.3f;
/// Minimum heat that hides the scene.
constexpr float kOpaque = 0.3f;
/// Radius of the mark, in sizes of the lumel.
constexpr float kMarkSize = 2.5f;
constexpr glm::vec3 kMark{0.0f, 0.9f, 1.0f};

glm::vec3 world_position(const SolveScene& prepared, const Lumel& lumel)
{
    return prepared.scene.instances[lumel.instance].transform * glm::vec4(lumel.position, 1.0f);
}

/// [N] Albedos for a render with white light: R 0…1 by density, G 1 at the mark.
std::vector<glm::vec3> layers_of(const SolveScene& prepared, std::span<const float> density,
                                 std::uint32_t marked)
{
    const float densest = *std::max_element(density.begin(), density.end());
    const Lumel& centre = prepared.lumels.lumels[marked];
    const glm::vec3 at = world_position(prepared, centre);
    std::vector<glm::vec3> layers;
    for (std::size_t i = 0; i < density.size(); ++i) {
        const Lumel& lumel = prepared.lumels.lumels[i];
        const bool near =
            lumel.instance == centre.instance &&
            glm::distance(world_position(prepared, lumel), at) <= kMarkSize * centre.size;
        const float heat = densest > 0.0f ? std::pow(density[i] / densest, kHeatPower) : 0.0f;
        layers.push_back(std::numbers::pi_v<float> * glm::vec3(heat, near ? 1.0f : 0.0f, 0.0f));
    }
    return layers;
}

/// Dark red, red, yellow, white for 0…1.
glm::vec3 heat_color(float heat)
{
    const glm::vec3 color(0.3f + 1.4f * heat, 2.0f * heat - 0.6f, 3.0f * heat - 2.0f);
    return glm::clamp(color, glm::vec3(0.0f), glm::vec3(1.0f));
}

}  // namespace

Image why_picture(const gpu::Device& device, const SolveScene& prepared,
                  std::span<const glm::vec3> irradiance, std::span<const float> density,
                  std::uint32_t lumel, int width)
{
    const View view = choose_view(prepared.scene, prepared.rays);
    const auto picture = [&](PreviewShows shows, std::span<const glm::vec3> values) {
        const Image map = finish_map(prepared.scene, prepared.atlas, prepared.lumels, values);
        return render_preview(device, prepared.scene, prepared.atlas, map, view, width, shows);
    };
    Image result = tone_map(picture(PreviewShows::light, irradiance));
    const Image layers = picture(PreviewShows::map, layers_of(prepared, density, lumel));
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            float* pixel = result.at(x, y);
            const float heat = std::clamp(layers.at(x, y)[0], 0.0f, 1.0f);
            const float mark = std::clamp(layers.at(x, y)[1], 0.0f, 1.0f);
            const glm::vec3 gray(kDim * float(luminance({pixel[0], pixel[1], pixel[2]})));
            const glm::vec3 lit = glm::mix(gray, heat_color(heat), std::min(heat / kOpaque, 1.0f));
            const glm::vec3 color = glm::mix(lit, kMark, mark);
            for (int c = 0; c < 3; ++c)
                pixel[c] = color[c];
        }
    return result;
}

}  // namespace lumel
