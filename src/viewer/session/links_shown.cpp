// Draws the links of a lumel as lines.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/core/luminance.h"
#include "viewer/session/session.h"

namespace lumel {
namespace {

/// Brightness of the lit scene behind the lines.
constexpr float kDim = 0.4f;
/// Range of light with distinct line colours, in powers of ten.
constexpr float kDecades = 3.0f;
/// Opacity of occluded parts of a line.
constexpr float kHidden = 0.25f;
constexpr int kDot = 2;  ///< radius of the dot at a line's end [pixels]

glm::vec3 place_of(const Scene& scene, const Lumel& lumel)
{
    return glm::vec3(scene.instances[lumel.instance].transform * glm::vec4(lumel.position, 1.0f));
}

void mix(Image& picture, const glm::ivec2& at, const glm::vec3& colour, float part)
{
    if (at.x < 0 || at.y < 0 || at.x >= picture.width || at.y >= picture.height)
        return;
    float* const pixel = picture.at(at.x, at.y);
    for (int c = 0; c < 3; ++c)
        pixel[c] += part * (colour[c] - pixel[c]);
    if (picture.channels == 4)
        pixel[3] = 1.0f;
}

void darken(Image& picture)
{
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            float* const pixel = picture.at(x, y);
            const auto grey = float(luminance({pixel[0], pixel[1], pixel[2]}));
            std::fill(pixel, pixel + 3, kDim * grey);
        }
}

/// 1 for the most light, 0 for kDecades powers of ten less.
float heat_of(const ViewLink& link, double most)
{
    const double light = luminance(link.light);
    return light > 0.0 ? std::clamp(1.0f + float(std::log10(light / most)) / kDecades, 0.0f, 1.0f)
                       : 0.0f;
}

}  // namespace

void ViewSession::probe(const glm::ivec2& pixel)
{
    check_inside(pixel);
    probe_ = seen_at(pixel);
}

/// E [lm/m²] of a lumel, with the lamps' factors.
glm::vec3 ViewSession::emission_of(const Lumel& lumel) const
{
    if (lumel.emission == glm::vec3(0.0f))
        return lumel.emission;
    const Mesh& mesh = shown_.meshes[std::size_t(shown_.instances[lumel.instance].mesh)];
    for (const ViewLamp& lamp : lamps_)
        if (!lamp.is_light && std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                                          [&](const Primitive& primitive) {
                                              return primitive.material == int(lamp.index);
                                          }))
            return lamp.factor * played_[lamp.index] * lumel.emission;
    return lumel.emission;
}

std::vector<ViewLink> ViewSession::links()
{
    std::vector<ViewLink> found;
    if (!probe_ || probe_->lumel == kNoLumel)
        return found;
    const LumelLinks& links = live_.links();
    const std::vector<Lumel>& lumels = live_.lumels().lumels;
    const std::uint32_t own = probe_->lumel;
    const glm::vec3 from = place_of(live_.scene(), lumels[own]);
    const float far = glm::distance(rays().low(), rays().high());
    const float each = 1.0f / float(links.rays());
    const std::vector<glm::vec3>& irradiance = irradiance_of(by_links_);
    for (std::uint32_t ray = 0; ray < links.rays(); ++ray) {
        const std::uint32_t end = links.of(own)[ray];
        if (end < lumels.size()) {
            const Lumel& other = lumels[end];
            found.push_back(
                {.name = live_.scene().instances[other.instance].name,
                 .to = place_of(live_.scene(), other),
                 .light = each * (emission_of(other) + live_.albedo()[end] * irradiance[end])});
        } else if (end == links.sky()) {
            const glm::vec3 direction = links.direction(own, ray);
            found.push_back({.name = "sky",
                             .to = from + far * direction,
                             .light = each * std::numbers::pi_v<float> * sky_ *
                                      sky_radiance(live_.scene().sky, direction)});
        } else {
            found.push_back({.to = from});
        }
    }
    return found;
}

/// Draws occluded parts of the line with less opacity.
void ViewSession::draw_link(Image& picture, const glm::vec3& from, const ViewLink& link, float heat)
{
    const glm::vec2 all(size());
    const std::optional<glm::vec2> begin = place_in_picture(camera_.view(), from),
                                   end = place_in_picture(camera_.view(), link.to);
    if (!begin || !end)
        return;
    const glm::vec3 colour = scale_color(heat);
    const glm::vec2 way = (*end - *begin) * all;
    const int steps = std::clamp(int(std::ceil(std::max(std::abs(way.x), std::abs(way.y)))), 1,
                                 picture.width + picture.height);
    const float ray_offset = rays().ray_offset() * 2.0f;
    for (int step = 0; step <= steps; ++step) {
        const float part = float(step) / float(steps);
        const bool seen = rays().sees(camera_.eye(), glm::mix(from, link.to, part), ray_offset, 0);
        const glm::vec2 at = glm::mix(*begin, *end, part) * all;
        mix(picture, glm::ivec2(glm::floor(at)), colour, seen ? 1.0f : kHidden);
    }
    const glm::ivec2 last(glm::floor(*end * all));
    const bool seen = rays().sees(camera_.eye(), link.to, ray_offset, 0);
    for (int y = -kDot; y <= kDot; ++y)
        for (int x = -kDot; x <= kDot; ++x)
            mix(picture, last + glm::ivec2(x, y), colour, seen ? 1.0f : kHidden);
}

Image ViewSession::links_picture()
{
    Image result = lit_picture();
    std::vector<ViewLink> found = links();
    if (found.empty())
        return result;
    darken(result);
    std::stable_sort(found.begin(), found.end(), [](const ViewLink& a, const ViewLink& b) {
        return luminance(a.light) < luminance(b.light);
    });
    const double most = luminance(found.back().light);
    const glm::vec3 from = place_of(live_.scene(), live_.lumels().lumels[probe_->lumel]);
    for (const ViewLink& link : found)
        if (!link.name.empty())
            draw_link(result, from, link, heat_of(link, most));
    return result;
}

}  // namespace lumel
