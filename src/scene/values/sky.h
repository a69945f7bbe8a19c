#pragma once
// Light from infinity: radiance over the whole sphere.

#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Radiance over all directions as a latitude-longitude image, constant within texels. Row 0 is the
/// zenith (+y); column 0 begins at -x and columns turn through -z, so that the image's centre is at
/// +x and three quarters of its width at +z.
struct Sky {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;  ///< [height][width] [cd/m²]; empty: no sky

    bool empty() const { return radiance.empty(); }
};

/// Radiance [cd/m²] from a unit direction; 0 without a sky.
glm::vec3 sky_radiance(const Sky& sky, const glm::vec3& direction);

/// Solid angle [sr] of a texel of a row.
float sky_texel_angle(const Sky& sky, int row);

/// Irradiance [lx] of an open horizontal plane facing up.
glm::dvec3 sky_irradiance(const Sky& sky);

/// A sampled direction of the sky and its density.
struct SkySample {
    glm::vec3 direction;  ///< unit, towards the sky
    glm::vec3 radiance;   ///< [cd/m²]
    float density;        ///< per solid angle [1/sr]
};

/// Samples the sky by brightness: texels by luminance × solid angle, uniform within them.
class SkySampler {
public:
    /// The sky must outlive this. sample() requires !empty().
    explicit SkySampler(const Sky& sky);

    bool empty() const { return row_sums_.empty(); }  ///< the sky has no light
    SkySample sample(const glm::vec2& at) const;      ///< at: uniform sample in the unit square
    float density(const glm::vec3& direction) const;  ///< probability density of sample() [1/sr]

private:
    const Sky* sky_;
    std::vector<double> row_sums_;  ///< [height] normalised running sum of luminance × solid angle
    std::vector<double> texel_sums_;  ///< [height][width] normalised running sum within the row
};

}  // namespace lumel
