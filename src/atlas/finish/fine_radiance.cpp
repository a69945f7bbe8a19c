#include "atlas/finish/fine_radiance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "atlas/finish/finish.h"
#include "atlas/lumels/patch.h"
#include "atlas/lumels/sides.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

// Share of the area that the density serves; a few denser surfaces, such as a stamp on a letter,
// are ignored.
constexpr double kShareServed = 0.95;
// Rows of texels per task.
constexpr int kBand = 32;
// Samples per side of a texel: textures may still be denser.
constexpr int kLooks = 2;

const Primitive& primitive_of(const Scene& scene, const Surface& surface)
{
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[surface.instance].mesh)];
    return mesh.primitives[surface.primitive];
}

// Twice the area of a triangle.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

// Twice the area of a triangle in its texture [texture texels]; 0 without a texture.
double texture_area2(const Scene& scene, const TextureUse& use, const Primitive& primitive,
                     const std::array<std::uint32_t, 3>& source)
{
    if (use.texture < 0 || primitive.texcoords[use.texcoord].empty())
        return 0.0;
    const Texture& texture = scene.textures[std::size_t(use.texture)];
    const auto place = [&](std::uint32_t vertex) {
        const glm::vec2 texcoord = primitive.texcoords[use.texcoord][vertex];
        const glm::dvec3 uv = use.transform * glm::vec3(texcoord, 1.0f);
        return glm::dvec2(uv.x * texture.width, uv.y * texture.height);
    };
    return texture.width * texture.height == 1
               ? 0.0
               : area2(place(source[0]), place(source[1]), place(source[2]));
}

struct Share {
    double density;  // texture texels per side of an atlas texel
    double area;     // area with that density [atlas texels]
};

// A triangle of the atlas to be filled.
struct Fill {
    const Primitive* primitive;
    TexelTriangle triangle;
    int first_row, last_row;  // rows of fine texels
};

// Material at an atlas position [atlas texels].
MaterialSample look_at(const Scene& scene, const Fill& fill, const glm::dvec2& place)
{
    const Primitive& primitive = *fill.primitive;
    const glm::vec3 weights(fill.triangle.weights(place));
    glm::vec2 texcoord[kTexcoordSets] = {};
    glm::vec4 color(primitive.colors.empty() ? 1.0f : 0.0f);
    for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t vertex = fill.triangle.source[std::size_t(corner)];
        for (int set = 0; set < kTexcoordSets; ++set)
            if (!primitive.texcoords[set].empty())
                texcoord[set] += weights[corner] * primitive.texcoords[set][vertex];
        if (!primitive.colors.empty())
            color += weights[corner] * primitive.colors[vertex];
    }
    return sample_material(scene, primitive.material, texcoord, color);
}

// Bilinear sample; `place` in texels of the image.
glm::vec3 light_at(const Image& map, const glm::dvec2& place)
{
    const auto span = [](double coordinate, int size) {
        const double position = std::clamp(coordinate - 0.5, 0.0, double(size - 1));
        const int first = int(position);
        return std::pair(first, float(position - first));
    };
    const auto [x, right] = span(place.x, map.width);
    const auto [y, down] = span(place.y, map.height);
    const auto texel = [&](int column, int row) {
        const float* rgb = map.at(std::min(column, map.width - 1), std::min(row, map.height - 1));
        return glm::vec3(rgb[0], rgb[1], rgb[2]);
    };
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), right),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), right), down);
}

// Adds the radiance of the samples inside the triangle to a fine texel, and their number to its
// alpha, because two triangles may share a texel.
void add_looks(const Scene& scene, const Fill& fill, const Image& irradiance, int x, int y,
               int scale, float* rgba)
{
    for (int look = 0; look < kLooks * kLooks; ++look) {
        const glm::ivec2 cell(look % kLooks, look / kLooks);
        const glm::dvec2 within = (glm::dvec2(cell) + 0.5) / double(kLooks);
        const glm::dvec2 place = (glm::dvec2(x, y) + within) / double(scale);
        const glm::dvec3 weights = fill.triangle.weights(place);
        if (std::min({weights.x, weights.y, weights.z}) < 0.0)
            continue;
        const MaterialSample sample = look_at(scene, fill, place);
        const glm::vec3 radiance =
            sample.albedo * light_at(irradiance, place) * std::numbers::inv_pi_v<float> +
            sample.emitted;
        for (int c = 0; c < 3; ++c)
            rgba[c] += radiance[c];
        rgba[3] += 1.0f;
    }
}

void add_fills(const Scene& scene, const Surface& surface, int scale, int rows,
               std::vector<Fill>& fills)
{
    for (std::uint32_t t = 0; t < surface.chart.size(); ++t) {
        TexelTriangle triangle(scene, surface, t);
        if (triangle.collapsed)
            continue;
        const int first = int(std::floor(triangle.plane.low().y * scale));
        const int last = int(std::floor(triangle.plane.high().y * scale));
        fills.push_back({&primitive_of(scene, surface), std::move(triangle),
                         std::clamp(first, 0, rows - 1), std::clamp(last, 0, rows - 1)});
    }
}

std::vector<Fill> fills_of(const Scene& scene, const Atlas& atlas, int scale)
{
    std::vector<Fill> fills;
    for (const Surface& surface : atlas.surfaces) {
        add_fills(scene, surface, scale, atlas.height * scale, fills);
        if (has_own_back(atlas, surface))
            add_fills(scene, own_back_of(atlas, surface), scale, atlas.height * scale, fills);
    }
    return fills;
}

void fill_rows(Image& fine, const Scene& scene, const std::vector<Fill>& fills,
               const Image& irradiance, int scale, int first_row, int last_row)
{
    for (const Fill& fill : fills) {
        const int first = std::max(first_row, fill.first_row);
        const int last = std::min(last_row, fill.last_row);
        for (int y = first; y <= last; ++y) {
            const Polygon strip =
                clip_to_slab(fill.triangle.plane, 1, double(y) / scale, double(y + 1) / scale);
            if (strip.count < 3)
                continue;
            const int left = std::max(int(std::floor(strip.low().x * scale)), 0);
            const int right = std::min(int(std::floor(strip.high().x * scale)), fine.width - 1);
            for (int x = left; x <= right; ++x)
                add_looks(scene, fill, irradiance, x, y, scale, fine.at(x, y));
        }
    }
    for (int y = first_row; y <= last_row; ++y)
        for (int x = 0; x < fine.width; ++x)
            if (float* rgba = fine.at(x, y); rgba[3] > 0.0f) {
                for (int c = 0; c < 3; ++c)
                    rgba[c] /= rgba[3];
                rgba[3] = 1.0f;
            }
}

// Atlas texels without any sample get the value of the coarse map.
void fill_thin(Image& fine, const Image& coarse, int scale)
{
    const auto each = [&](int x, int y, const auto& visit) {
        for (int row = y * scale; row < (y + 1) * scale; ++row)
            for (int column = x * scale; column < (x + 1) * scale; ++column)
                visit(fine.at(column, row));
    };
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x) {
            const float* from = coarse.at(x, y);
            bool met = false;
            each(x, y, [&](const float* rgba) { met = met || rgba[3] > 0.0f; });
            if (from[3] > 0.0f && !met)
                each(x, y, [&](float* rgba) { std::copy(from, from + 4, rgba); });
        }
}

}  // namespace

int texture_density(const Scene& scene, const Atlas& atlas)
{
    std::vector<Share> shares;
    double all = 0.0;
    for (const Surface& surface : atlas.surfaces) {
        const Primitive& primitive = primitive_of(scene, surface);
        const Material& material = scene.materials[std::size_t(primitive.material)];
        if (is_uniform(material))
            continue;
        for (std::uint32_t t = 0; t < surface.chart.size(); ++t) {
            const TexelTriangle triangle(scene, surface, t);
            const double area = triangle.plane.area();
            if (triangle.collapsed || !(area > 0.0))
                continue;
            const double texels = std::max(
                texture_area2(scene, material.base_color_texture, primitive, triangle.source),
                texture_area2(scene, material.emissive_texture, primitive, triangle.source));
            shares.push_back({std::sqrt(texels / (2.0 * area)), area});
            all += area;
        }
    }
    std::stable_sort(shares.begin(), shares.end(),
                     [](const Share& a, const Share& b) { return a.density < b.density; });
    double served = 0.0;
    for (const Share& share : shares)
        if ((served += share.area) >= kShareServed * all)
            return std::max(1, int(std::min(std::ceil(share.density), double(atlas.width))));
    return 1;
}

Image fine_radiance(const Scene& scene, const Atlas& atlas, const Image& irradiance,
                    const Image& radiance, int scale)
{
    Image fine(atlas.width * scale, atlas.height * scale, 4);
    const std::vector<Fill> fills = fills_of(scene, atlas, scale);
    const auto bands = std::size_t((fine.height + kBand - 1) / kBand);
    parallel_for(bands, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t band = first; band < last; ++band)
            fill_rows(fine, scene, fills, irradiance, scale, int(band) * kBand,
                      std::min((int(band) + 1) * kBand, fine.height) - 1);
    });
    fill_thin(fine, radiance, scale);
    dilate(fine);
    return fine;
}

}  // namespace lumel
