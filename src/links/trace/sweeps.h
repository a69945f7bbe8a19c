#pragma once
// Solves for all bounces over stored links.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/world_lumels.h"
#include "links/trace/source_term.h"

namespace lumel {

/// Solves X = C + K ρ X for the irradiance of sub-lumels without direct light:
///
///     X_p = (1/n_p) Σ_k (C_pk + w_pk ρ X[target_pk]),
///
/// where C is direct and sky light at the ends of the rays and w the weight of a link. Jacobi
/// sweeps until converged; if they are slow, as in bright closed rooms, with a coarse correction by
/// groups of sub-lumels that face the same way in one cell of the scene.
class LinkSolver {
public:
    /// All arguments must outlive this.
    LinkSolver(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers);

    /// X [P] [lx]; starts from `received` unless it is empty. residual: RMS of the light left out,
    /// relative to each sub-lumel's own. least_factor: minimum assumed factor between changes of
    /// successive sweeps. Returns that of the last sweeps, 0 in the dark, for other links of the
    /// same scene: where `received` is nearly solved, noise hides how slowly the level of the light
    /// converges. Throws
    /// Error{input} if the light of a closed room is never absorbed.
    double solve(const LinkTable& links, const SourceTerm& source, double residual,
                 std::vector<glm::vec3>& received, double least_factor = 0.0) const;

    /// X [P][kLampLanes] of a few lamps at once, from darkness; source: of these.
    void solve_lamps(const LinkTable& links, const SourceTerm& source, double residual,
                     std::vector<glm::vec3>& received) const;
    /// The same by one sweep, from the X of other links.
    void gather_lamps(const LinkTable& links, const SourceTerm& source,
                      std::vector<glm::vec3>& received) const;

private:
    class Groups;
    template <std::size_t Lanes>
    class Sweeps;

    /// Links with the light at their ends.
    struct System {
        const LinkTable& links;
        const SourceTerm& source;
    };

    const LinkWork& work_;
    const SubLumels& parts_;
    const LinkNumbers& numbers_;
    std::vector<glm::vec3> albedo_;     ///< [P] ρ, in the order of the sweeps
    std::vector<std::uint32_t> group_;  ///< [P]
    std::uint32_t group_count_ = 0;
};

}  // namespace lumel
