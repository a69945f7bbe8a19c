#pragma once
// Light from infinitely far away: a picture of the whole sphere around the scene.

#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Radiance over all directions, constant within each texel, as a latitude-longitude image:
/// row 0 is the zenith (+y), column 0 begins at -x and columns turn through -z, so that the
/// image's centre lies towards +x and three quarters of its width towards +z.
struct Sky {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;  ///< [height][width] [cd/m²]; empty: no light from outside

    bool empty() const { return radiance.empty(); }
};

/// Radiance [cd/m²] that comes from a unit direction; 0 without a sky.
glm::vec3 sky_radiance(const Sky& sky, const glm::vec3& direction);

/// Solid angle [sr] of a texel of a row.
float sky_texel_angle(const Sky& sky, int row);

/// Irradiance [lx] of an open horizontal plane that faces up.
glm::dvec3 sky_irradiance(const Sky& sky);

/// A direction of the sky, drawn with a known density.
struct SkySample {
    glm::vec3 direction;  ///< unit, towards the sky
    glm::vec3 radiance;   ///< [cd/m²]
    float density;        ///< per solid angle [1/sr]
};

/// Draws directions where the sky is bright: texels by luminance × solid angle, uniform within.
class SkySampler {
public:
    /// The sky must outlive this. One without light can not be drawn from.
    explicit SkySampler(const Sky& sky);

    bool empty() const { return row_sums_.empty(); }  ///< no light at all
    SkySample sample(const glm::vec2& at) const;      ///< `at` in the unit square
    float density(const glm::vec3& direction) const;  ///< with which `sample` draws it [1/sr]

private:
    const Sky* sky_;
    std::vector<double> row_sums_;  ///< [height] running sum over rows of luminance × angle, to 1
    std::vector<double> texel_sums_;  ///< [height][width] running sum within the row, to 1
};

}  // namespace lumel
