#include "methods/glossy/phong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/core/frame.h"
#include "base/core/parallel.h"

namespace lumel {

float phong_density(float mirrored, float shininess)
{
    const float scale = (shininess + 1.0f) * float(0.5 / std::numbers::pi);
    return scale * std::pow(std::max(mirrored, 0.0f), shininess);
}

glm::vec3 phong_direction(const glm::vec3& mirror, float shininess, const glm::vec2& at)
{
    const float height = std::pow(1.0f - at.x, 1.0f / (shininess + 1.0f));
    const float radius = std::sqrt(std::max(0.0f, 1.0f - height * height));
    const float angle = 2.0f * std::numbers::pi_v<float> * at.y;
    return frame_about(mirror) *
           glm::vec3(radius * std::cos(angle), radius * std::sin(angle), height);
}

float phong_lobe(float cos_in, float cos_out, float mirrored, float shininess)
{
    if (cos_in <= 0.0f || cos_out <= 0.0f)
        return 0.0f;
    return phong_density(mirrored, shininess) / std::max(cos_in, cos_out);
}

float phong_albedo(float cos_in, float shininess)
{
    // Directions are drawn from the lobe, whose density cancels all but cosθ' / max(…).
    constexpr int kRings = 64, kSectors = 64;
    const double cos_mirror = std::max(double(cos_in), 0.0);
    const double sin_mirror = std::sqrt(std::max(0.0, 1.0 - cos_mirror * cos_mirror));
    double sum = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double c = std::pow((ring + 0.5) / kRings, 1.0 / (double(shininess) + 1.0));
        const double s = std::sqrt(1.0 - c * c);
        for (int sector = 0; sector < kSectors; ++sector) {
            const double angle = 2.0 * std::numbers::pi * (sector + 0.5) / kSectors;
            const double cos_out = c * cos_mirror + s * std::cos(angle) * sin_mirror;
            if (cos_out > 0.0)
                sum += cos_out / std::max(cos_mirror, cos_out);
        }
    }
    return float(sum / (kRings * kSectors));
}

std::vector<float> phong_albedo_table()
{
    constexpr std::size_t kColumns = kAlbedoCosines + 1;
    std::vector<float> table(kAlbedoExponents * kColumns);
    parallel_for(kAlbedoExponents, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            const float exponent =
                std::pow(kMaxShininess, float(row) / float(kAlbedoExponents - 1));
            float* values = &table[row * kColumns];
            double mean = 0.0, weights = 0.0;
            for (std::uint32_t column = 0; column < kAlbedoCosines; ++column) {
                const float cosine = float(column) / float(kAlbedoCosines - 1);
                values[column] = phong_albedo(cosine, exponent);
                // ∫ a cosθ dω / π = 2 ∫ a cosθ d(cosθ), by the trapezium rule.
                const double weight = cosine * (column + 1 == kAlbedoCosines ? 0.5 : 1.0);
                mean += weight * double(values[column]);
                weights += weight;
            }
            values[kAlbedoCosines] = float(mean / weights);
        }
    });
    return table;
}

}  // namespace lumel
