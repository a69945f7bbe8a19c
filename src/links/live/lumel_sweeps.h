#pragma once
// All bounces of light over the links of lumels, a part of a sweep at a time.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "links/live/lumel_links.h"

namespace lumel {

/// What a sweep changed of the light that lumels send: root of the mean square, by their mean.
struct SweepChange {
    double all = 0.0;
    double dark = 0.0;  ///< the same of lumels between 0.5 and 30 % of the mean of all
};

/// Sweeps after which light counts as at rest as it is.
inline constexpr int kMaxSweeps = 20000;

/// Light still to come, as far as the last two sweeps tell: of all lumels by their mean, and of
/// dark ones by theirs: 0…1.
struct StillToCome {
    double all = 1.0, dark = 1.0;
};

/// Solves H = D + X, X_i = 1/n Σ_k B[link_ik], B = ρ H by forward Gauss-Seidel sweeps in place:
/// links that end in no lumel find B = 0. One thread, so that the same edits give the same bytes.
class LumelSweeps {
public:
    /// The links must outlive it.
    explicit LumelSweeps(const LumelLinks& links);
    /// Of the rays whose cells lie on the white (0) or on the black fields (1) of a board alone, as
    /// if they were all; to begin from the light of all of them.
    LumelSweeps(const LumelSweeps& all, std::uint32_t half);

    /// D [N] [lx] or ρ [N] are others now: begins from X as it is.
    void begin(const std::vector<glm::vec3>& direct, const std::vector<glm::vec3>& albedo);
    /// Sweeps on, over `lumels` of them at most. True where a sweep ends.
    bool step(std::size_t lumels);

    StillToCome still_to_come() const;
    /// Is no more than that to come, of all and of dark ones, or has it taken too long?
    bool rests(double residual) const;
    /// Sweeps since begin().
    int sweeps() const { return sweeps_; }
    /// At a lumel [lx].
    glm::vec3 irradiance(std::size_t lumel) const
    {
        return glm::vec3(direct_[lumel] + received_[lumel]);
    }
    /// The part of it that has bounced [lx].
    glm::vec3 received(std::size_t lumel) const { return glm::vec3(received_[lumel]); }
    /// B of a lumel, or what comes from another end of a link: none.
    const glm::vec4& sent(std::size_t end) const { return sent_[end]; }
    std::uint64_t bytes() const;

private:
    static constexpr std::uint32_t kAll = ~0u;

    /// Of light that lumels send, all channels together.
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
    std::uint32_t half_ = kAll;
    // Padded, so that each is one aligned load.
    std::vector<glm::vec4> direct_, albedo_, received_;  ///< [N]
    std::vector<glm::vec4> sent_;                        ///< [ends] B
    std::size_t next_ = 0;                               ///< lumel of this sweep
    double mean_ = 0.0;                                  ///< B of all channels together
    Sums all_, dark_;                                    ///< of this sweep so far
    SweepChange change_, before_;                        ///< of the last two sweeps
    int sweeps_ = 0;
};

}  // namespace lumel
