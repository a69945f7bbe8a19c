#pragma once
// Direct light, kept apart by what sends it.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/progress_callback.h"
#include "lights/source_estimate.h"
#include "links/live/link_context.h"

namespace lumel {

struct GroupedLightOptions {
    std::uint32_t few_rays = 4;    ///< from each lumel to each source; powers of two
    std::uint32_t many_rays = 16;  ///< where those see a part of it
    /// That light may take [bytes]. Senders beyond it share one group: to dim one of them, that is
    /// found again.
    std::uint64_t most_bytes = std::uint64_t(1) << 30;
    std::uint32_t seed = 0;
    bool halves = false;  ///< keeps what half of the rays tell otherwise, see off()
};

/// The light that each lamp, each emissive material and the bright part of the sky send to each
/// lumel. What a lumel receives of a group depends on itself and the group alone.
class LightGroups {
public:
    /// Finds it. What is given must outlive it.
    LightGroups(const LinkContext& place, const GroupedLightOptions& options,
                const ProgressCallback& progress = {});

    /// All that a sender sends is `factor` times what the scene says.
    bool set_factor(LightSources::Part part, std::uint32_t index, const glm::vec3& factor);
    /// A light of the scene has moved, and the sources know.
    void find_again(LightSources::Part part, std::uint32_t index);
    /// Surfaces have moved, and the sources know.
    void place();
    /// A thing has moved from a box, and this is placed: of these lumels, finds again what changes.
    /// Once all lumels have followed, light is as if all had been found. Returns for how many
    /// lumels one group was found again, in all.
    std::uint64_t follow(std::uint32_t thing, const Box& before, std::size_t first,
                         std::size_t last);

    /// Σ over groups [N] [lx].
    const std::vector<glm::vec3>& sum();
    /// What the first half of the rays found less what all of them did, Σ over groups [N] [lx], as
    /// if all factors were 1, but of groups that senders share; only with options.halves.
    std::vector<glm::vec3> off() const;
    std::size_t groups() const { return groups_.size(); }
    std::uint64_t bytes() const;

private:
    struct Emitter {
        LightSources::Part part;
        std::uint32_t index;
        glm::vec3 factor{1.0f};
        std::vector<std::uint32_t> sources;
    };
    struct Group {
        std::vector<std::uint32_t> senders;
        std::vector<glm::vec3>
            light;  ///< [N] [lx] of the one sender by factor 1, of several by theirs
        std::vector<glm::vec3> off;  ///< [N] [lx] of it, see off()

        bool is_shared() const { return senders.size() > 1; }
    };

    /// Light of a lumel [lx], and by how much that of half of the rays differs.
    struct Found {
        glm::vec3 light{0.0f}, off{0.0f};

        void add(const Found& other, const glm::vec3& factor)
        {
            light += factor * other.light;
            off += factor * other.off;
        }
    };

    void list_senders();
    void add_groups();
    void make_room(Group& group) const;
    std::uint32_t sender_of(LightSources::Part part, std::uint32_t index) const;
    void find(Group& group, const ProgressCallback& progress = {});
    void find_at(Group& group, std::size_t lumel) const;
    Found light_of(const Group& group, std::size_t lumel) const;
    Found light_of(const Emitter& sender, std::size_t lumel) const;
    Found by_one(std::uint32_t source, std::uint32_t stream, std::size_t lumel) const;
    Found by_many(const Emitter& sender, std::uint32_t stream, std::size_t lumel) const;
    RayOrigin start_of(std::size_t lumel, std::uint32_t ray) const;
    glm::vec3 transmittance(const RayOrigin& start, const SourceSample& sample,
                            std::uint32_t seed) const;
    bool is_moved(const Group& group, std::uint32_t thing) const;
    bool may_cross(const Group& group, std::size_t lumel, const Box& before, const Box& now) const;
    bool may_cross(std::uint32_t source, std::size_t lumel, const Box& box) const;

    const LinkContext place_;
    const GroupedLightOptions options_;
    std::vector<Emitter> senders_;
    std::vector<Group> groups_;
    std::vector<glm::vec3> sum_;  ///< [N] [lx]
    bool summed_ = false;
};

}  // namespace lumel
