// With u, v in 0…1 from the image's left and top:
//
//     direction = (-cos φ sin θ, cos θ, -sin φ sin θ),   θ = π v,  φ = 2π u
//
// A texel has the solid angle Δφ (cos θ₀ − cos θ₁); uniform directions in it have a uniform φ and a
// uniform cos θ.

#include "scene/values/sky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/gtc/constants.hpp>

#include "base/core/luminance.h"

namespace lumel {
namespace {

struct Texel {
    int row = 0;
    int column = 0;
};

double cosine_above(const Sky& sky, int row)
{
    return std::cos(std::numbers::pi * double(row) / double(sky.height));
}

double angle_of(const Sky& sky, int row)
{
    return 2.0 * std::numbers::pi / double(sky.width) *
           (cosine_above(sky, row) - cosine_above(sky, row + 1));
}

Texel texel_towards(const Sky& sky, const glm::vec3& direction)
{
    const double theta = std::acos(std::clamp(double(direction.y), -1.0, 1.0));
    const double phi = std::atan2(-double(direction.z), -double(direction.x));
    const double u = phi / (2.0 * std::numbers::pi) + (phi < 0.0 ? 1.0 : 0.0);
    return {std::min(int(theta / std::numbers::pi * sky.height), sky.height - 1),
            std::min(int(u * sky.width), sky.width - 1)};
}

std::size_t index_of(const Sky& sky, const Texel& texel)
{
    return std::size_t(texel.row) * std::size_t(sky.width) + std::size_t(texel.column);
}

/// Weight of an entry of running sums.
double share_of(const double* sums, int entry)
{
    return entry == 0 ? sums[0] : sums[entry] - sums[entry - 1];
}

struct Draw {
    int entry = 0;
    double rest = 0.0;  ///< fraction within the entry, 0…1
};

/// The entry of normalised running sums that contains `at`; never one of weight 0.
Draw draw(const double* sums, int count, double at)
{
    const double* found = std::upper_bound(sums, sums + count, at);
    const int entry = std::min(int(found - sums), count - 1);
    const double before = entry == 0 ? 0.0 : sums[entry - 1];
    return {entry, std::clamp((at - before) / share_of(sums, entry), 0.0, 1.0)};
}

/// Divides running sums by the last, so that they end at exactly 1.
void normalise(double* sums, int count)
{
    const double total = sums[count - 1];
    for (int i = 0; i < count && total > 0.0; ++i)
        sums[i] /= total;
}

}  // namespace

glm::vec3 sky_radiance(const Sky& sky, const glm::vec3& direction)
{
    return sky.empty() ? glm::vec3(0.0f)
                       : sky.radiance[index_of(sky, texel_towards(sky, direction))];
}

float sky_texel_angle(const Sky& sky, int row)
{
    return float(angle_of(sky, row));
}

glm::dvec3 sky_irradiance(const Sky& sky)
{
    // ∫ cos θ dω of a texel is Δφ (sin²θ₁ − sin²θ₀) / 2, down to the horizon.
    glm::dvec3 sum(0.0);
    for (int row = 0; row < (sky.height + 1) / 2; ++row) {
        const double above = cosine_above(sky, row);
        const double below = std::max(0.0, cosine_above(sky, row + 1));
        const double weight = std::numbers::pi / sky.width * (above * above - below * below);
        for (int column = 0; column < sky.width; ++column)
            sum += weight * glm::dvec3(sky.radiance[index_of(sky, {row, column})]);
    }
    return sum;
}

SkySampler::SkySampler(const Sky& sky) : sky_(&sky)
{
    if (sky.empty())
        return;
    row_sums_.resize(std::size_t(sky.height));
    texel_sums_.resize(sky.radiance.size());
    double total = 0.0;
    for (int row = 0; row < sky.height; ++row) {
        const std::size_t first = index_of(sky, {row, 0});
        double sum = 0.0;
        for (std::size_t i = first; i < first + std::size_t(sky.width); ++i)
            texel_sums_[i] = sum += std::max(0.0, luminance(sky.radiance[i]));
        normalise(&texel_sums_[first], sky.width);
        row_sums_[std::size_t(row)] = total += sum * angle_of(sky, row);
    }
    normalise(row_sums_.data(), sky.height);
    if (total <= 0.0)
        row_sums_.clear();
}

SkySample SkySampler::sample(const glm::vec2& at) const
{
    // The largest float below 1 keeps the result within the last entry of positive weight.
    const glm::dvec2 place(glm::clamp(at, 0.0f, std::nextafter(1.0f, 0.0f)));
    const Draw row = draw(row_sums_.data(), sky_->height, place.y);
    const std::size_t first = index_of(*sky_, {row.entry, 0});
    const Draw column = draw(&texel_sums_[first], sky_->width, place.x);

    const double y =
        glm::mix(cosine_above(*sky_, row.entry), cosine_above(*sky_, row.entry + 1), row.rest);
    const double phi = 2.0 * std::numbers::pi * (column.entry + column.rest) / sky_->width;
    const double sine = std::sqrt(std::max(0.0, 1.0 - y * y));
    const double share =
        share_of(row_sums_.data(), row.entry) * share_of(&texel_sums_[first], column.entry);
    return {glm::vec3(-std::cos(phi) * sine, y, -std::sin(phi) * sine),
            sky_->radiance[first + std::size_t(column.entry)],
            float(share / angle_of(*sky_, row.entry))};
}

float SkySampler::density(const glm::vec3& direction) const
{
    if (empty())
        return 0.0f;
    const Texel texel = texel_towards(*sky_, direction);
    const double share = share_of(row_sums_.data(), texel.row) *
                         share_of(&texel_sums_[index_of(*sky_, {texel.row, 0})], texel.column);
    return float(share / angle_of(*sky_, texel.row));
}

}  // namespace lumel
