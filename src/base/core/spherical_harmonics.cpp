#include "base/core/spherical_harmonics.h"

#include "base/core/harmonics.shared.h"

namespace lumel {

std::array<float, kMaxCoefficients> harmonics(const glm::vec3& d)
{
    return {kY0,
            kY1 * d.y,
            kY1 * d.z,
            kY1 * d.x,
            kY2 * d.x * d.y,
            kY2 * d.y * d.z,
            kY20 * (3.0f * d.z * d.z - 1.0f),
            kY2 * d.x * d.z,
            kY22 * (d.x * d.x - d.y * d.y)};
}

glm::vec3 irradiance_at(std::span<const glm::vec3> coefficients, const glm::vec3& normal)
{
    const auto y = harmonics(normal);
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        sum += kCosineLobe[std::size_t(band_of(int(i)))] * y[i] * coefficients[i];
    return sum;
}

}  // namespace lumel
