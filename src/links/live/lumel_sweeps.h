#pragma once
// Gauss-Seidel sweeps for all bounces over lumel links, in resumable parts.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "links/live/lumel_links.h"

namespace lumel {

/// Change of lumels' radiosity in a sweep: RMS relative to their mean.
struct SweepChange {
    double all = 0.0;
    double dark = 0.0;  ///< for lumels between 0.5 and 30 % of the mean of all
};

/// Maximum sweeps; light then counts as converged.
inline constexpr int kMaxSweeps = 20000;

/// Relative residual estimated from the last two sweeps, 0…1: of all lumels and of dark ones.
struct StillToCome {
    double all = 1.0, dark = 1.0;
};

/// Solves H = D + X, X_i = 1/n Σ_k B[link_ik], B = ρ H by forward Gauss-Seidel sweeps in place;
/// other ends have B = 0. Single-threaded, so that the same edits give the same bytes.
class LumelSweeps {
public:
    /// The links must outlive this.
    explicit LumelSweeps(const LumelLinks& links);

    /// Starts with new D [N] [lx] and ρ [N], from the current X.
    void begin(const std::vector<glm::vec3>& direct, const std::vector<glm::vec3>& albedo);
    /// Sweeps over at most `lumels` lumels. Returns true at the end of a sweep.
    bool step(std::size_t lumels);

    StillToCome still_to_come() const;
    /// True if both residuals are at most `residual`, or after kMaxSweeps.
    bool rests(double residual) const;
    /// Sweeps since begin().
    int sweeps() const { return sweeps_; }
    /// H at a lumel [lx].
    glm::vec3 irradiance(std::size_t lumel) const
    {
        return glm::vec3(direct_[lumel] + received_[lumel]);
    }
    /// X at a lumel [lx].
    glm::vec3 received(std::size_t lumel) const { return glm::vec3(received_[lumel]); }
    /// B of a lumel; 0 for other ends.
    const glm::vec4& sent(std::size_t end) const { return sent_[end]; }
    std::uint64_t bytes() const;

private:
    /// Sums of radiosity, over all channels.
    struct Sums {
        double light = 0.0, squares = 0.0, count = 0.0;

        void add(double sent, double change)
        {
            light += sent;
            squares += change * change;
            count += 1.0;
        }
        double relative() const;
    };

    glm::vec4 arriving(std::size_t lumel) const;

    const LumelLinks& links_;
    // Padded, so that each is one aligned load.
    std::vector<glm::vec4> direct_, albedo_, received_;  ///< [N]
    std::vector<glm::vec4> sent_;                        ///< [ends] B
    std::size_t next_ = 0;                               ///< next lumel of this sweep
    double mean_ = 0.0;                                  ///< mean B, summed over channels
    Sums all_, dark_;                                    ///< current sweep
    SweepChange change_, before_;                        ///< last two sweeps
    int sweeps_ = 0;
};

}  // namespace lumel
