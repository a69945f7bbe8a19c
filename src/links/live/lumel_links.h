#pragma once
// Ray links from lumel to lumel, updated when objects move.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "atlas/cells/near_lumels.h"
#include "links/live/link_context.h"

namespace lumel {

/// Counts of links retraced after a move.
struct Retraced {
    std::uint64_t started = 0;  ///< the ray started on the object
    std::uint64_t ended = 0;    ///< it ended on the object before
    std::uint64_t crossed = 0;  ///< it hits the object now

    std::uint64_t all() const { return started + ended + crossed; }
    Retraced& operator+=(const Retraced& other)
    {
        started += other.started;
        ended += other.ended;
        crossed += other.crossed;
        return *this;
    }
};

/// Side of the grid of a lumel's rays. Throws Error{input} unless `rays` is 4, 16, 64 or 256.
std::uint32_t side_of_rays(std::uint32_t rays);

/// Each lumel sends side² cosine-distributed rays, one per cell of a grid over (sin² θ, φ). A ray
/// depends only on its number and on the atlas position of its lumel, so it can be regenerated.
class LumelLinks {
public:
    /// Traces all links. side: grid side, a power of two. The members of `place` must
    /// outlive this.
    LumelLinks(const LinkContext& place, std::uint32_t side, std::uint32_t seed);

    /// Retraces the rays of these lumels that start on `thing`, ended on it or hit it now. After
    /// all lumels, links equal those of a new LumelLinks.
    Retraced follow(std::uint32_t thing, std::span<const std::uint32_t> lumels);

    /// Recomputes sky light for a changed sky. Requires that the sources are updated.
    void find_sky();

    std::uint32_t rays() const { return side_ * side_; }  ///< per lumel
    /// Ends of a lumel's rays [side²]: lumels, or the ends below.
    std::span<const std::uint32_t> of(std::size_t lumel) const
    {
        return {links_.data() + lumel * rays(), rays()};
    }
    /// Direction of a ray: unit, world space.
    glm::vec3 direction(std::size_t lumel, std::uint32_t ray) const;
    std::uint32_t sky() const { return lumels_; }
    /// Ends of absorbed rays: those below the surface, and those that hit an instance without a
    /// lumel.
    std::uint32_t lost() const { return lumels_ + 1; }
    std::uint32_t lost_on(std::uint32_t instance) const { return lumels_ + 2 + instance; }
    /// Number of ends, lumels included.
    std::size_t ends() const { return on_thing_.size(); }

    std::uint64_t bytes() const
    {
        return (links_.size() + on_thing_.size()) * sizeof(std::uint32_t) +
               (sky_light_.size() + white_sky_light_.size()) * sizeof(glm::vec3);
    }

    /// Sky light by rays [lx] per lumel, without the bright parts that are sources.
    const std::vector<glm::vec3>& sky_light() const { return sky_light_; }
    /// Its part by rays of the white half.
    const std::vector<glm::vec3>& white_sky_light() const { return white_sky_light_; }
    /// Checkerboard half of a ray's cell: 0 white, 1 black.
    std::uint32_t half_of(std::uint32_t ray) const { return (ray % side_ + ray / side_) % 2; }

private:
    class Rays;

    template <class Visit>
    void for_rays_towards(const Rays& rays, std::size_t lumel, const Box& box,
                          const Visit& visit) const;
    std::uint32_t end_of(const Rays& rays, std::uint32_t k) const;
    /// Rays that miss an object: keep their end, or go on to the next hit.
    enum class Misses { stay, go_on };
    std::optional<std::uint32_t> end_by(const Rays& rays, std::uint32_t k,
                                        const glm::vec3& direction, std::uint32_t thing,
                                        Misses misses) const;
    std::uint32_t end_at(const RayHit& hit) const;
    void trace(std::size_t lumel);
    Retraced follow(std::size_t lumel, std::uint32_t thing, const Box& box);
    void find_sky(const Rays& rays, std::size_t lumel);
    std::uint32_t key_of(std::size_t lumel) const;

    const LinkContext place_;
    NearLumels near_;
    std::uint32_t side_, seed_, lumels_;
    std::vector<std::uint32_t> links_;     ///< [N][side²]
    std::vector<std::uint32_t> on_thing_;  ///< [ends] an object, or DynamicRayScene::kStatic
    std::vector<glm::vec3> sky_light_, white_sky_light_;  ///< [N]
};

}  // namespace lumel
