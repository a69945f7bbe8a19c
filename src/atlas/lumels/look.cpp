// Mean material of a texel.

#include <algorithm>
#include <cmath>

#include "atlas/lumels/patch.h"

namespace lumel {

namespace {

// Samples per side of a texel: few for magnified textures, otherwise one per texture texel, up to a
// limit: 64 stratified samples have an error well below 1 per cent.
constexpr int kMinGrid = 4;
constexpr int kMaxGrid = 8;
// Above this number of parts per texel, one sample each suffices.
constexpr std::size_t kManyParts = 16;

/// Material at a point of a part.
MaterialSample sample_at(const Scene& scene, const Part& part, const glm::dvec2& point)
{
    const Primitive& primitive = *part.primitive;
    const glm::vec3 w(part.weights(point));
    const auto& source = part.triangle.source;
    glm::vec2 texcoord[kTexcoordSets] = {};
    for (int set = 0; set < kTexcoordSets; ++set)
        if (const std::vector<glm::vec2>& from = primitive.texcoords[set]; !from.empty())
            texcoord[set] = w.x * from[source[0]] + w.y * from[source[1]] + w.z * from[source[2]];
    glm::vec4 color(1.0f);
    if (const std::vector<glm::vec4>& from = primitive.colors; !from.empty())
        color = w.x * from[source[0]] + w.y * from[source[1]] + w.z * from[source[2]];
    return sample_material(scene, primitive.material, texcoord, color);
}

/// Texture texels per side of an atlas texel.
double texture_texels(const Scene& scene, const Part& part, const TextureUse& use)
{
    if (use.texture < 0 || part.triangle.collapsed)
        return 0.0;
    const std::vector<glm::vec2>& texcoords = part.primitive->texcoords[use.texcoord];
    if (texcoords.empty())
        return 0.0;
    const Texture& texture = scene.textures[use.texture];
    std::array<glm::dvec2, 3> at;
    for (int i = 0; i < 3; ++i)
        at[i] = glm::dvec2(use.transform * glm::vec3(texcoords[part.triangle.source[i]], 1.0f)) *
                glm::dvec2(texture.width, texture.height);
    return std::sqrt(0.5 * std::abs(cross(at[1] - at[0], at[2] - at[0])) /
                     part.triangle.plane.area());
}

/// Deterministic pseudo-random number in 0…1 (a multiply-and-shift hash).
double noise(std::uint32_t a, std::uint32_t b)
{
    std::uint32_t hash = a * 0x9E3779B1u ^ (b + 0x7F4A7C15u) * 0x85EBCA77u;
    hash = (hash ^ hash >> 15) * 0x2C1B3C6Du;
    hash = (hash ^ hash >> 12) * 0x297A2D39u;
    return double(hash ^ hash >> 15) / 4294967296.0;
}

/// Adds a sample that represents this area.
void add(Look& sum, const MaterialSample& sample, double area)
{
    sum.albedo += area * double(sample.opacity) * glm::dvec3(sample.albedo);
    sum.diffuse += area * double(sample.opacity) * glm::dvec3(sample.diffuse);
    sum.specular += area * double(sample.opacity) * glm::dvec3(sample.specular);
    sum.roughness += area * double(sample.opacity) * double(sample.roughness);
    sum.luminance += area * double(sample.opacity) * glm::dvec3(sample.emitted);
    sum.opacity += area * double(sample.opacity);
    sum.area += area;
}

/// Samples all parts on a grid over the texel. `met`: parts with at least one sample.
void sample_on_grid(const Scene& scene, const std::vector<Part>& parts, int x, int y, Look& sum,
                    std::vector<bool>& met)
{
    const Part* largest = &parts.front();
    for (const Part& part : parts)
        largest = part.world_area > largest->world_area ? &part : largest;
    const Material& material = *largest->material;
    const double wanted =
        std::ceil(std::max(texture_texels(scene, *largest, material.base_color_texture),
                           texture_texels(scene, *largest, material.emissive_texture)));
    const int grid = int(std::clamp(wanted, double(kMinGrid), double(kMaxGrid)));
    // Strata wider than a texture texel would alias with its pattern, so samples are jittered.
    const double jitter = wanted > kMaxGrid ? 1.0 : 0.0;
    for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
            const std::uint32_t stratum = 2u * std::uint32_t(j * grid + i);
            const std::uint32_t texel = std::uint32_t(y) << 16 ^ std::uint32_t(x);
            const glm::dvec2 shift(jitter * (noise(texel, stratum) - 0.5),
                                   jitter * (noise(texel, stratum + 1u) - 0.5));
            const glm::dvec2 point =
                glm::dvec2(x, y) + (glm::dvec2(i + 0.5, j + 0.5) + shift) / double(grid);
            for (std::size_t p = 0; p < parts.size(); ++p) {
                if (parts[p].triangle.collapsed || !parts[p].polygon.contains(point))
                    continue;
                add(sum, sample_at(scene, parts[p], point),
                    parts[p].world_area / (parts[p].polygon.area() * grid * grid));
                met[p] = true;
                break;
            }
        }
}

}  // namespace

Look mean_look(const Scene& scene, const std::vector<Part>& parts, int x, int y)
{
    Look mean;
    std::vector<bool> met(parts.size(), false);
    const bool uniform = std::all_of(parts.begin(), parts.end(),
                                     [](const Part& part) { return is_uniform(*part.material); });
    if (!uniform && parts.size() <= kManyParts)
        sample_on_grid(scene, parts, x, y, mean, met);
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (!met[p])
            add(mean, sample_at(scene, parts[p], parts[p].polygon.centroid()), parts[p].world_area);

    if (mean.opacity > 0.0) {
        mean.albedo /= mean.opacity;
        mean.diffuse /= mean.opacity;
        mean.specular /= mean.opacity;
        mean.roughness /= mean.opacity;
        mean.luminance /= mean.opacity;
    }
    mean.opacity = mean.area > 0.0 ? mean.opacity / mean.area : 0.0;
    return mean;
}

}  // namespace lumel
