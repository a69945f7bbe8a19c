#pragma once
// Solves for all bounces over stored links.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/world_lumels.h"
#include "links/sweeps/device_sweeps.h"
#include "links/sweeps/level_groups.h"
#include "links/sweeps/source_term.h"

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

    struct Swept {
        double factor = 0.0;  ///< between changes of the last sweeps, 0 in the dark
        int sweeps = 0;

        bool operator==(const Swept&) const = default;
    };

    /// X [P] [lx]; starts from `received` unless it is empty. residual: RMS of the light left out,
    /// relative to each sub-lumel's own. least_factor: minimum assumed factor between changes of
    /// successive sweeps: that of other links of the same scene, since noise hides how slowly the
    /// level of the light converges where `received` is nearly solved. Throws Error{input} if light
    /// grows without bound, as in a closed room that absorbs none.
    Swept solve(const LinkTable& links, const SourceTerm& source, double residual,
                std::vector<glm::vec3>& received, double least_factor = 0.0) const;

    /// The same on a GPU, with the same results bit for bit. links: a copy on that device. Throws
    /// gpu::OutOfMemory; `received` is then unchanged.
    Swept solve_on(DeviceSweeps& device, const DeviceLinks& copy, const LinkTable& links,
                   const SourceTerm& source, double residual, std::vector<glm::vec3>& received,
                   double least_factor = 0.0) const;

    /// X [P][kLampLanes] of a few lamps at once, from darkness; source: of these.
    void solve_lamps(const LinkTable& links, const SourceTerm& source, double residual,
                     std::vector<glm::vec3>& received) const;
    /// The same by one sweep, from the X of other links.
    void gather_lamps(const LinkTable& links, const SourceTerm& source,
                      std::vector<glm::vec3>& received) const;

    /// [P] ρ, in the order of the sweeps
    const std::vector<glm::vec3>& albedo() const { return albedo_; }

private:
    template <std::size_t Lanes>
    class HostSweeps;

    /// Links with the light at their ends.
    struct System {
        const LinkTable& links;
        const SourceTerm& source;
    };

    template <std::size_t Lanes, class Sweeps>
    Swept run(Sweeps& sweeps, const System& system, double residual, double least_factor) const;

    const LinkWork& work_;
    const SubLumels& parts_;
    const LinkNumbers& numbers_;
    const LevelGroups groups_;
    std::vector<glm::vec3> albedo_;  ///< [P]
};

}  // namespace lumel
