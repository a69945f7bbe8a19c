#pragma once
// The source term of the equation that sweeps solve: light at the ends of links, without further
// bounces.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "links/direct/direct.h"
#include "links/filter/filter.h"
#include "links/kept/link_table.h"

namespace lumel {

/// Light of several lamps at once, w unused: one aligned load per lamp.
template <std::size_t Lanes>
using LaneLight = std::array<glm::vec4, Lanes>;

/// Lamps whose light is solved for at once: two cache lines of light a link.
inline constexpr std::size_t kLampLanes = 8;

struct SourceTerm {
    /// [P][lanes] Σ over rays of reflected direct light, and sky [lx]; of rays of this rank only.
    /// w: 0, so that sweeps can add to it.
    std::vector<glm::vec4> light;
    /// [P] Σ of the weights of rays that count: not those to sub-lumels without any. Where all
    /// count, their number; but at least Σ of weights × reflectances of near links.
    std::vector<float> rays;
    bool is_closed = false;  ///< all rays hit reflecting surfaces

    /// 1 / rays. 0 without any: links to such a sub-lumel do not count, and light of its lumel's
    /// other parts would leak.
    float share_of_ray(std::size_t part) const
    {
        return rays[part] > 0.0f ? 1.0f / rays[part] : 0.0f;
    }
};

/// Direct light that each number of a link's end reflects [lm/m²].
class ReflectedLight {
public:
    ReflectedLight(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
                   const DirectEstimator& direct);

    glm::vec3 at(LinkEnd end) const
    {
        const OfNumber& found = of_number_[end.number()];
        return found.cells == kEven
                   ? found.light_or_albedo
                   : found.light_or_albedo * direct_.light_in(found.cells, end.cell());
    }

private:
    static constexpr std::uint32_t kEven = ~0u;
    /// Side by side, as links read both. Where cells differ: the albedo and index_of_cells().
    struct OfNumber {
        glm::vec3 light_or_albedo{0.0f};
        std::uint32_t cells = kEven;
    };

    const DirectEstimator& direct_;
    std::vector<OfNumber> of_number_;  ///< [numbers]
};

/// Direct light of a few lamps that each number of a link's end reflects [lm/m²].
class LampsReflected {
public:
    /// first: of kLampLanes lamps of `lamps`; those beyond the last are dark.
    LampsReflected(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
                   const DirectEstimator& direct, const LampTable& lamps, std::size_t first);

    const LaneLight<kLampLanes>& at(LinkEnd end, LaneLight<kLampLanes>& of_cells) const
    {
        const LaneLight<kLampLanes>& light = of_number_[end.number()];
        return light[0].w == kVaries ? find_of_cell(end, of_cells) : light;
    }
    /// Gathered by a near link [lx], of these shares.
    LaneLight<kLampLanes> near(std::span<const NearShare> shares) const;
    /// The sky's light in the lane of its lamp.
    LaneLight<kLampLanes> of_sky(const glm::vec3& light) const;

private:
    static constexpr float kVaries = 1.0f;

    const LaneLight<kLampLanes>& find_of_cell(LinkEnd end, LaneLight<kLampLanes>& light) const;
    bool has(std::size_t lamp) const { return lamp >= first_ && lamp < first_ + kLampLanes; }

    const LinkWork& work_;
    const SubLumels& parts_;
    const LinkNumbers& numbers_;
    const DirectEstimator& direct_;
    const LampTable& lamps_;
    std::size_t first_, count_;
    std::vector<LaneLight<kLampLanes>> of_number_;  ///< [numbers] w of the first: kVaries if cells
                                                    ///< differ
};

/// Light of a few sources that are not in the scene, as each number of a link's end reflects it
/// [lm/m²].
class OutsideReflected {
public:
    /// direct: light of kLampLanes sources at each lumel [N][kLampLanes] [lx].
    OutsideReflected(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
                     std::span<const glm::vec3> direct);

    const LaneLight<kLampLanes>& at(LinkEnd end, LaneLight<kLampLanes>&) const
    {
        return of_number_[end.number()];
    }
    /// Gathered by a near link [lx], of these shares.
    LaneLight<kLampLanes> near(std::span<const NearShare> shares) const;
    /// None: the light of the sky is direct light.
    LaneLight<kLampLanes> of_sky(const glm::vec3&) const { return {}; }

private:
    std::vector<LaneLight<kLampLanes>> of_number_;  ///< [numbers]
};

SourceTerm find_source_term(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, const ReflectedLight& reflected,
                            const LinkTable& links);
/// Of kLampLanes lamps at once.
SourceTerm find_source_term(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, const LampsReflected& reflected,
                            const LinkTable& links);
SourceTerm find_source_term(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, const OutsideReflected& reflected,
                            const LinkTable& links);

/// Distances that the rays of several tables went, about.
RayDistances find_distances(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, std::span<const LinkTable* const> tables);

}  // namespace lumel
