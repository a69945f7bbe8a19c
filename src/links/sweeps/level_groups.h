#pragma once
// Correction of the level of light in groups of sub-lumels, where sweeps are slow.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "links/direct/link_work.h"
#include "links/kept/link_table.h"
#include "links/sweeps/sweeps.shared.h"

namespace lumel {

/// Groups of sub-lumels that face the same way in one cell of the scene.
struct LevelGroups {
    LevelGroups(const LinkWork& work, const SubLumels& parts);

    std::vector<std::uint32_t> of_part;  ///< [P]
    std::uint32_t count = 0;
};

/// Corrects the level of groups after a sweep x → y of the reflected light. With K_ab the
/// fraction of group a's received light that comes from b, times ρ, and r_a the mean change of a,
/// the mean residual of a is (1 - K)⁻¹ K r. It is distributed in proportion to the light that
/// sub-lumels send, so that none is added to dark cavities, which would lose it slowly.
class LevelCorrection {
public:
    /// rays: SourceTerm::rays. Only `groups` must outlive this. Throws Error{input} if the light of
    /// a closed room is never absorbed.
    LevelCorrection(const LevelGroups& groups, const LinkWork& work, const SubLumels& parts,
                    const LinkNumbers& numbers, const LinkTable& links,
                    const std::vector<float>& rays);

    /// Sub-lumels of groups, to sum over.
    const std::vector<std::uint32_t>& members() const { return members_; }  ///< [P] by group
    const std::vector<GroupSpan>& spans() const { return spans_; }          ///< of members
    const std::vector<float>& areas() const { return areas_; }  ///< [P] relative to the mean
    const LevelGroups& groups() const { return groups_; }

    struct Found {
        std::vector<glm::vec4> factors;  ///< [groups] on light; w: 0
        double residual;                 ///< RMS, relative to the light of the groups
    };
    /// sums: of the spans.
    Found find(std::span<const GroupSums> sums) const;

private:
    /// Rows of K in fixed point, whose sums do not depend on their order; those that no link leaves
    /// are empty.
    using Rows = std::vector<std::vector<std::array<std::int64_t, 3>>>;  ///< [groups][groups or 0]
    struct Links;

    void list_members();
    void count_links(const Links& links);
    void count_row(const Links& links, std::uint32_t i, const LinkRow& row, Rows& sums) const;
    void invert(std::vector<double>& m) const;

    const LevelGroups& groups_;
    const std::size_t size_;
    std::vector<double> inverse_[3];      ///< [groups][groups] (1 - K)⁻¹ of each channel
    std::vector<double> group_areas_;     ///< [groups]
    std::vector<float> areas_;            ///< [P]
    std::vector<std::uint32_t> members_;  ///< [P]
    std::vector<GroupSpan> spans_;
    std::vector<std::uint32_t> group_of_span_;  ///< [spans]
};

}  // namespace lumel
