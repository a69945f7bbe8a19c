#pragma once
// The source term of the equation that sweeps solve: light at the ends of links, without further
// bounces.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "links/direct/direct.h"
#include "links/filter/filter.h"
#include "links/kept/link_table.h"

namespace lumel {

struct SourceTerm {
    /// [P] Σ over rays of reflected direct light, and sky [lx]. w: 0, so that sweeps can add to it.
    std::vector<glm::vec4> light;
    /// [P] Σ of the weights of rays that count: not those to sub-lumels without any. Where all
    /// count, their number.
    std::vector<float> rays;
    bool is_closed = false;  ///< all rays hit reflecting surfaces
};

/// Direct light that each number of a link's end reflects [lm/m²].
class ReflectedLight {
public:
    ReflectedLight(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
                   const DirectEstimator& direct);

    glm::vec3 at(LinkEnd end) const
    {
        const glm::vec4& light = of_number_[end.number()];
        return light.w == kVaries ? of_cell(end) : glm::vec3(light);
    }

private:
    static constexpr float kVaries = 1.0f;

    glm::vec3 of_cell(LinkEnd end) const;

    const LinkWork& work_;
    const SubLumels& parts_;
    const LinkNumbers& numbers_;
    const DirectEstimator& direct_;
    std::vector<glm::vec4> of_number_;  ///< [numbers] w: kVaries if cells differ
};

SourceTerm find_source_term(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, const ReflectedLight& reflected,
                            const LinkTable& links);

/// Distances that the rays of several tables went, about.
RayDistances find_distances(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, std::span<const LinkTable* const> tables);

}  // namespace lumel
