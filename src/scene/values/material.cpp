#include <algorithm>
#include <cmath>

#include "scene/values/scene.h"
#include "scene/values/srgb.h"

namespace lumel {

namespace {

/// Column or row inside the image, by the wrap mode.
int wrapped(long long texel, int size, Wrap wrap)
{
    if (wrap == Wrap::clamp)
        return int(std::clamp<long long>(texel, 0, size - 1));
    const long long period = wrap == Wrap::mirrored ? 2LL * size : size;
    const long long within = ((texel % period) + period) % period;
    return int(within < size ? within : period - 1 - within);
}

/// Encoding of texture bytes.
enum class Coding { srgb, linear };

glm::vec4 texel_at(const Texture& texture, int x, int y, Coding coding)
{
    const std::size_t row = std::size_t(y) * std::size_t(texture.width);
    const std::uint8_t* rgba = &texture.rgba[(row + std::size_t(x)) * 4];
    if (coding == Coding::linear)
        return glm::vec4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0f;
    const auto& linear = srgb_to_linear();
    return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]], float(rgba[3]) / 255.0f};
}

/// The two texels around a coordinate, and its fraction between them.
struct TexelSpan {
    int first;
    int second;
    float fraction;
};

TexelSpan span_of(float coordinate, int size, Wrap wrap)
{
    // Larger coordinates have no sub-texel precision.
    constexpr double kFarthestTexel = 1e12;
    const double position =
        std::clamp(double(coordinate) * size - 0.5, -kFarthestTexel, kFarthestTexel);
    const double floor = std::floor(position);
    const auto texel = static_cast<long long>(floor);
    return {wrapped(texel, size, wrap), wrapped(texel + 1, size, wrap), float(position - floor)};
}

/// Bilinear sample, decoded; white without a texture.
glm::vec4 sample_texture(const Scene& scene, const TextureUse& use,
                         const glm::vec2 texcoord[kTexcoordSets], Coding coding = Coding::srgb)
{
    if (use.texture < 0)
        return glm::vec4(1.0f);
    const Texture& texture = scene.textures[std::size_t(use.texture)];
    const glm::vec3 uv = use.transform * glm::vec3(texcoord[use.texcoord], 1.0f);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
        return texel_at(texture, 0, 0, coding);
    const TexelSpan x = span_of(uv.x, texture.width, use.wrap_s);
    const TexelSpan y = span_of(uv.y, texture.height, use.wrap_t);
    const auto texel = [&](int column, int row) { return texel_at(texture, column, row, coding); };
    const glm::vec4 top = glm::mix(texel(x.first, y.first), texel(x.second, y.first), x.fraction);
    const glm::vec4 bottom =
        glm::mix(texel(x.first, y.second), texel(x.second, y.second), x.fraction);
    return glm::mix(top, bottom, y.fraction);
}

/// Coverage of the surface by its alpha.
float share_there(const Material& look, float alpha)
{
    switch (look.alpha_mode) {
    case AlphaMode::mask:
        return alpha >= look.alpha_cutoff ? 1.0f : 0.0f;
    case AlphaMode::blend:
        return std::clamp(alpha, 0.0f, 1.0f);
    default:
        return 1.0f;
    }
}

}  // namespace

glm::vec3 capped(const glm::vec3& albedo, float most)
{
    const float brightest = std::max({albedo.r, albedo.g, albedo.b});
    return brightest > most ? albedo * (most / brightest) : albedo;
}

MaterialSample sample_material(const Scene& scene, int material,
                               const glm::vec2 texcoord[kTexcoordSets],
                               const glm::vec4& vertex_color)
{
    const Material& look = scene.materials[std::size_t(material)];
    const glm::vec4 texel = sample_texture(scene, look.base_color_texture, texcoord);
    const glm::vec4 base = look.base_color * vertex_color * texel;
    MaterialSample sample;
    const glm::vec3 color = glm::clamp(glm::vec3(base), 0.0f, 1.0f);
    sample.albedo = capped(color, scene.max_albedo);
    const float there = share_there(look, base.a);
    sample.opacity = there * (1.0f - look.transmission);
    sample.tint = glm::vec3(1.0f);
    if (const float glass = there * look.transmission; glass > 0.0f) {
        const glm::vec3 tint = glm::clamp(glm::vec3(look.base_color * texel), 0.0f, 1.0f);
        sample.tint = (1.0f - there + glass * tint) / (1.0f - there + glass);
    }
    // glTF's metals reflect their base colour specularly; other materials lose their specular share
    // from diffuse light.
    const glm::vec4 gloss =
        sample_texture(scene, look.metallic_roughness_texture, texcoord, Coding::linear);
    const float metallic = std::clamp(look.metallic * gloss.b, 0.0f, 1.0f);
    const glm::vec3& f0 = look.dielectric_specular;
    sample.roughness = std::clamp(look.roughness * gloss.g, 0.0f, 1.0f);
    const glm::vec3 specular = glm::mix(f0, color, metallic);
    const glm::vec3 diffuse = (1.0f - metallic) * (1.0f - std::max({f0.r, f0.g, f0.b})) * color;
    const glm::vec3 both = diffuse + specular;
    const float brightest = std::max({both.r, both.g, both.b});
    const float scale = brightest > scene.max_albedo ? scene.max_albedo / brightest : 1.0f;
    sample.specular = scale * specular;
    sample.diffuse = scale * diffuse;
    sample.emitted =
        look.emitted * glm::vec3(sample_texture(scene, look.emissive_texture, texcoord));
    return sample;
}

float shininess_of(double roughness)
{
    // A half-vector lobe of roughness r has the exponent 2 / r⁴ - 2; the lobe about the mirror
    // direction has a quarter of it.
    constexpr double kMin = 1.0, kMax = kMaxShininess;
    const double alpha2 = std::pow(std::max(roughness, 1e-3), 4.0);
    return float(std::clamp((2.0 / alpha2 - 2.0) / 4.0, kMin, kMax));
}

bool may_be_transparent(const Material& material, const Primitive& primitive)
{
    if (material.transmission > 0.0f)
        return true;
    return material.alpha_mode != AlphaMode::opaque &&
           (material.base_color.a < 1.0f || material.base_color_texture.texture >= 0 ||
            !primitive.colors.empty());
}

bool is_coloured_glass(const Material& material)
{
    const glm::vec4& color = material.base_color;
    return material.transmission > 0.0f &&
           (material.base_color_texture.texture >= 0 || color.r != color.g || color.g != color.b);
}

bool is_uniform(const Material& material)
{
    return material.base_color_texture.texture < 0 && material.emissive_texture.texture < 0 &&
           material.metallic_roughness_texture.texture < 0;
}

}  // namespace lumel
