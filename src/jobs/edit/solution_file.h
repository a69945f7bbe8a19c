#pragma once
// solution.exr: the solution per lumel, from which a bake can be corrected.

#include <string>
#include <vector>

#include "atlas/packing/atlas.h"
#include "jobs/edit/kept_atlas.h"

namespace lumel {

/// Contents of the file, per texel.
struct StoredSolution {
    int side = 0;  ///< side of the atlas [texels]
    StoredCharts charts;
    std::vector<glm::vec3> front, back;  ///< [side][side] H [lx], 0 without a lumel
    std::vector<glm::vec3> open;         ///< [side][side] open fractions of fronts, of backs

    /// H and open fraction of a lumel at this texel of the stored atlas.
    const glm::vec3& irradiance(const Lumel& lumel, std::size_t texel) const
    {
        return (lumel.flags & kLumelBack ? back : front)[texel];
    }
    float open_share(const Lumel& lumel, std::size_t texel) const
    {
        return open[texel][lumel.flags & kLumelBack ? 1 : 0];
    }
};

/// R, G, B: H [lx] of fronts; A: the chart number, from 1; layer "back": H of backs; layer "open":
/// SolveScene::open of fronts in R, of backs in G; layer "shift": Atlas::back_shift of the chart in
/// R and G, in B 1 for Atlas::shows_front; layer kErrorLayer, unless error is empty: in R, the
/// error of the lumel that the map shows at a texel, with gutters as there. 32-bit float.
/// irradiance [N], open [N], error [N]. Throws Error{output}.
void write_solution(const std::string& path, const Lumels& lumels,
                    const std::vector<glm::vec3>& irradiance, const std::vector<float>& open,
                    const std::vector<float>& error = {});

/// Throws Error{input}.
StoredSolution read_solution(const std::string& path);

}  // namespace lumel
