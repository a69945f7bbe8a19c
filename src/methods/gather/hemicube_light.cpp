#include "methods/gather/hemicube_light.h"

#include "atlas/near/near_field.h"
#include "gpu/texture.h"
#include "raster/eyes/hemicube_tiles.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Form factor of a rectangle on a face of the hemicube of half side 1 about the origin, with +z
/// up: on the front face right × up, on a side face right × height.
float pixel_form_factor(std::uint32_t face, double right0, double right1, double up0, double up1)
{
    const auto corner = [&](double right, double up) {
        return face == 0 ? glm::vec3(-right, up, 1.0) : glm::vec3(right, 1.0, up);
    };
    const glm::vec3 corners[] = {corner(right0, up0), corner(right1, up0), corner(right1, up1),
                                 corner(right0, up1)};
    return polygon_form_factor(glm::vec3(0.0f), glm::vec3(0.0f, 0.0f, 1.0f), corners, 4);
}

}  // namespace

std::vector<std::uint32_t> nearest_lumels_by_side(const Lumels& lumels)
{
    std::vector<std::uint32_t> of_sides = lumels_by_side(lumels);
    std::vector<std::uint32_t> found;  // texels
    for (std::uint32_t texel = 0; texel < of_sides.size() / 2; ++texel)
        if (of_sides[2 * texel] != kNoLumel)
            found.push_back(texel);
    const auto width = std::uint32_t(lumels.width), height = std::uint32_t(lumels.height);
    for (std::size_t k = 0; k < found.size(); ++k) {
        const std::uint32_t texel = found[k], x = texel % width, y = texel / width;
        const auto pass_on = [&](bool there, std::uint32_t to) {
            if (!there || of_sides[2 * to] != kNoLumel)
                return;
            of_sides[2 * to] = of_sides[2 * texel];
            of_sides[2 * to + 1] = of_sides[2 * texel + 1];
            found.push_back(to);
        };
        pass_on(x > 0, texel - 1);
        pass_on(x + 1 < width, texel + 1);
        pass_on(y > 0, texel - width);
        pass_on(y + 1 < height, texel + width);
    }
    return of_sides;
}

std::vector<float> delta_form_factors(std::uint32_t side, bool standard_samples)
{
    const std::uint32_t samples = gpu::kManySamples;
    const Tiles tile = hemicube_tiles(side, 1);
    std::vector<float> factors(std::size_t(tile.width) * tile.height * samples);
    const double width = 2.0 / double(side);
    for (std::uint32_t face = 0; face < kHemicubeFaces; ++face) {
        const auto factor = [&](double right, double up, double height) {
            return pixel_form_factor(face, right, right + width, up, up + height);
        };
        const gpu::Area area = hemicube_face_area(tile.area(0), side, face);
        for (std::uint32_t y = 0; y < area.height; ++y)
            for (std::uint32_t x = 0; x < area.width; ++x) {
                float* of_pixel =
                    &factors[samples * (std::size_t(area.y + y) * tile.width + area.x + x)];
                const double right = width * x - 1.0, up = width * y - (face == 0 ? 1.0 : 0.0);
                const double part = width / samples;
                for (std::uint32_t s = 0; s < samples; ++s)
                    of_pixel[s] = standard_samples ? factor(right, up + part * s, part)
                                                   : factor(right, up, width) / float(samples);
            }
    }
    return factors;
}

}  // namespace lumel
