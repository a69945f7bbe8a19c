#pragma once
// solution.exr: the light of each lumel as solved, from which a bake can be corrected.

#include <string>
#include <vector>

#include "atlas/atlas.h"
#include "update/kept_atlas.h"

namespace lumel {

inline constexpr const char* kSolutionFile = "solution.exr";

/// What the file says, texel by texel.
struct StoredSolution {
    int side = 0;                        ///< of the atlas [texels]
    ChartMap charts;                     ///< [side][side]
    std::vector<glm::vec3> front, back;  ///< [side][side] H [lx], 0 where there is no such lumel

    /// H of a lumel of that atlas.
    const glm::vec3& of(const Lumel& lumel) const
    {
        return (lumel.flags & kLumelBack ? back : front)[lumel.texel];
    }
};

/// R, G, B: H [lx] of fronts; A: the number of the chart, from 1; layer "back": of backs. 32-bit
/// float. irradiance [N]. Throws Error{output}.
void write_solution(const std::string& path, const Lumels& lumels,
                    const std::vector<glm::vec3>& irradiance);

/// Throws Error{input}.
StoredSolution read_solution(const std::string& path);

}  // namespace lumel
