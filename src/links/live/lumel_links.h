#pragma once
// The lumel that each ray from a lumel meets, kept while things move.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "atlas/cells/near_lumels.h"
#include "base/core/progress_callback.h"
#include "links/kept/stored_links.h"
#include "links/live/link_context.h"

namespace lumel {

/// Rays of links that a move has traced again.
struct Retraced {
    std::uint64_t started = 0;  ///< on the thing
    std::uint64_t ended = 0;    ///< on it before
    std::uint64_t crossed = 0;  ///< met it in its new place

    std::uint64_t all() const { return started + ended + crossed; }
    Retraced& operator+=(const Retraced& other)
    {
        started += other.started;
        ended += other.ended;
        crossed += other.crossed;
        return *this;
    }
};

struct LinkChanges;

/// Each lumel sends side² rays, spread by the cosine to its normal: one into each cell of a grid
/// over (sin² θ, φ). A ray depends on the place of its lumel in the atlas and on its number alone,
/// so that it can be made again.
class LumelLinks {
public:
    /// Traces all of them. What is given must outlive it. side: a power of two.
    /// kept: links of the same scene or of one in which something stood elsewhere; then only those
    /// that may have changed are traced, and all of them are as if they had been.
    LumelLinks(const LinkContext& place, const Atlas& atlas, std::uint32_t side, std::uint32_t seed,
               const StoredLinks* kept = nullptr, const ProgressCallback& progress = {});

    /// A thing has moved: of these lumels, traces again what starts on it, ended on it, or meets it
    /// now. Once all lumels have followed, links are as if all had been traced.
    Retraced follow(std::uint32_t thing, std::span<const std::uint32_t> lumels);

    /// The sky is another, and the sources know: finds again what rays bring from it.
    void find_sky();

    std::uint32_t rays() const { return side_ * side_; }  ///< of a lumel
    /// What the rays of a lumel have met [side²]: a lumel or one of the ends below.
    std::span<const std::uint32_t> of(std::size_t lumel) const
    {
        return {links_.data() + lumel * rays(), rays()};
    }
    /// Where one of these rays goes: unit, world.
    glm::vec3 direction(std::size_t lumel, std::uint32_t ray) const;
    std::uint32_t sky() const { return lumels_; }
    /// Not above the surface, or nothing that reflects of an instance.
    std::uint32_t lost() const { return lumels_ + 1; }
    std::uint32_t lost_on(std::uint32_t instance) const { return lumels_ + 2 + instance; }
    /// All of them: lumels and ends.
    std::size_t ends() const { return on_thing_.size(); }

    /// Links of a scene that were not taken over from those that were kept.
    const Retraced& traced() const { return traced_; }
    /// Takes over all that a later run needs of them.
    void keep(StoredLinks& kept) const;
    std::uint64_t bytes() const
    {
        return (links_.size() + on_thing_.size()) * sizeof(std::uint32_t) +
               (sky_light_.size() + white_sky_light_.size()) * sizeof(glm::vec3);
    }

    /// What the rays of a lumel bring from the sky, without the bright parts that are a source
    /// [lx].
    const std::vector<glm::vec3>& sky_light() const { return sky_light_; }
    /// The part of it by rays of the white half.
    const std::vector<glm::vec3>& white_sky_light() const { return white_sky_light_; }
    /// Of rays whose cells lie on the white (0) and on the black fields (1) of a board.
    std::uint32_t half_of(std::uint32_t ray) const { return (ray % side_ + ray / side_) % 2; }
    /// What the rays of each quarter bring, each as if it were all [lx], where ends send `sent`:
    /// 0 and 1 are the white half, 2 and 3 the black one. Each has one of every four cells beside
    /// each other, by chance, so that quarters differ by noise alone.
    template <class Sent>
    std::array<glm::vec3, 4> by_quarters(std::size_t lumel, const Sent& sent) const;

private:
    class Rays;

    void trace_all(const ProgressCallback& progress);
    void take_over(const StoredLinks& kept, const LinkChanges& changes,
                   const ProgressCallback& progress);
    Retraced take_over(std::size_t lumel, const LinkChanges& changes);
    template <class Visit>
    void for_rays_towards(const Rays& rays, std::size_t lumel, const Box& box,
                          const Visit& visit) const;
    std::uint32_t end_of(const Rays& rays, std::uint32_t k) const;
    /// What rays do that do not meet a thing: end where they did, or further on.
    enum class Misses { stay, go_on };
    std::optional<std::uint32_t> end_by(const Rays& rays, std::uint32_t k,
                                        const glm::vec3& direction, std::uint32_t thing,
                                        Misses misses) const;
    std::uint32_t end_at(const RayHit& hit) const;
    void trace(std::size_t lumel);
    Retraced follow(std::size_t lumel, std::uint32_t thing, const Box& box);
    void find_sky(const Rays& rays, std::size_t lumel);
    glm::vec3 sky_by(std::size_t lumel, std::uint32_t ray) const;
    std::uint32_t key_of(std::size_t lumel) const;
    std::uint32_t quarter_of(std::size_t lumel, std::uint32_t ray) const;

    const LinkContext place_;
    NearLumels near_;
    std::uint32_t side_, seed_, lumels_;
    Retraced traced_;
    std::vector<std::uint32_t> links_;     ///< [N][side²]
    std::vector<std::uint32_t> on_thing_;  ///< [ends] a thing, or DynamicRayScene::kStatic
    std::vector<glm::vec3> sky_light_, white_sky_light_;  ///< [N]
};

template <class Sent>
std::array<glm::vec3, 4> LumelLinks::by_quarters(std::size_t lumel, const Sent& sent) const
{
    std::array<glm::vec3, 4> light{};
    const std::span<const std::uint32_t> links = of(lumel);
    for (std::uint32_t k = 0; k < links.size(); ++k)
        light[quarter_of(lumel, k)] += links[k] == sky() ? sky_by(lumel, k) : sent(links[k]);
    for (glm::vec3& quarter : light)
        quarter *= 4.0f / float(rays());
    return light;
}

}  // namespace lumel
