#pragma once
// All bounces of light over stored links.

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "links/tracer.h"

namespace lumel {

/// Where light of a solution comes from that is not over links.
enum class Counted { all, without_sky };

/// Solves X = C + K ρ X for what parts receive beside direct light:
///
///     X_p = (1/n_p) Σ_k (C_pk + w_pk ρ X[target_pk]),
///
/// C what the rays met of direct light and sky, w the weight of a link. By sweeps (Jacobi) until
/// still, and where they are slow, as in bright closed rooms, with a correction by groups of parts
/// that face alike and lie in one cell of the scene.
class LinkSolver {
public:
    /// What is given must outlive it.
    LinkSolver(const Lumels& lumels, const WorldLumels& world, const LumelParts& parts,
               const std::vector<std::uint32_t>& order);

    /// X [P] [lx], beginning from what it holds if that is not empty. Throws Error{input} if the
    /// light of a closed room is nowhere absorbed.
    void solve(const Gathered& gathered, std::vector<glm::vec3>& received) const;

    int sweeps() const { return sweeps_; }  ///< of the last solve

private:
    class Groups;

    const Lumels& lumels_;
    const LumelParts& parts_;
    const std::vector<std::uint32_t>& order_;
    std::vector<std::uint32_t> group_;  ///< [P]
    std::uint32_t group_count_ = 0;
    mutable int sweeps_ = 0;
};

}  // namespace lumel
