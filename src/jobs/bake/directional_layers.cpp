#include "jobs/bake/directional_layers.h"

#include "base/core/parallel.h"
#include "results/directional/directional.h"

namespace lumel {
namespace {

/// Filling and seams mix lumels of slightly different normals: matches the layers of covered texels
/// to the map again.
void match_texels(FinishedMaps& maps, const SolveScene& prepared,
                  const std::vector<std::uint32_t>& shown)
{
    const DirectionalFit fit(maps.layers.size() > std::size_t(coefficient_count(1)) ? 2 : 1);
    const std::vector<glm::vec3> normals = world_normals(prepared.scene, prepared.lumels);
    parallel_for(shown.size(), 4096, [&](std::size_t first, std::size_t last) {
        std::vector<glm::vec3> own(maps.layers.size());
        for (std::size_t texel = first; texel < last; ++texel) {
            if (shown[texel] == kNoLumel)
                continue;
            const auto rgb = [texel](Image& image) { return image.values.data() + texel * 4; };
            for (std::size_t c = 0; c < own.size(); ++c)
                own[c] = {rgb(maps.layers[c])[0], rgb(maps.layers[c])[1], rgb(maps.layers[c])[2]};
            const glm::vec3 light(rgb(maps.light)[0], rgb(maps.light)[1], rgb(maps.light)[2]);
            for (glm::vec3& coefficient : own)  // no light, no directions
                coefficient *= glm::vec3(glm::greaterThan(light, glm::vec3(0.0f)));
            fit.match(own, normals[shown[texel]], light);
            for (std::size_t c = 0; c < own.size(); ++c)
                for (int k = 0; k < 3; ++k)
                    rgb(maps.layers[c])[k] = own[c][k];
        }
    });
}

}  // namespace

DirectionalMaps finish_directional(const SolveScene& prepared,
                                   const std::vector<glm::vec3>& irradiance,
                                   const std::vector<std::vector<glm::vec3>>& coefficients)
{
    FinishedMaps maps =
        finish_maps(prepared.scene, prepared.atlas, prepared.lumels, irradiance, coefficients);
    if (!coefficients.empty())
        match_texels(maps, prepared, shown_lumels(prepared.lumels, irradiance));
    DirectionalMaps result{std::move(maps.light), {}};
    for (std::size_t c = 0; c < maps.layers.size(); ++c)
        result.layers.push_back({"sh." + std::to_string(c), std::move(maps.layers[c])});
    return result;
}

std::map<std::string, std::string> directional_metadata()
{
    return {{"directional",
             "sh.i: coefficient i = l*l + l + m of incoming radiance [cd/m2] in orthonormal real "
             "spherical harmonics Y_lm; world axes of the glTF: right-handed, +Y up"},
            {"directionalIrradiance",
             "H(n) = sum of A_l sh.i Y_lm(n), A = pi, 2 pi / 3, pi / 4, for normals n on the "
             "upper side of the surface"}};
}

}  // namespace lumel
