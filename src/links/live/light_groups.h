#pragma once
// Direct light per emitter or group of emitters.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "lights/source_estimate.h"
#include "links/live/link_context.h"

namespace lumel {

struct GroupedLightOptions {
    std::uint32_t few_rays = 4;    ///< from each lumel to each source; a power of two
    std::uint32_t many_rays = 16;  ///< if those see part of the source; a power of two
    /// Memory limit [bytes]. Emitters beyond it share one group, which is recomputed when one of
    /// them is dimmed.
    std::uint64_t most_bytes = std::uint64_t(1) << 30;
    std::uint32_t seed = 0;
};

/// Light from each lamp, each emissive material and the bright part of the sky at each lumel. A
/// lumel's light of a group depends on nothing but the two.
class LightGroups {
public:
    /// Computes all light. All arguments must outlive this.
    LightGroups(const LinkContext& place, const GroupedLightOptions& options);

    /// Scales an emitter's light to `factor` × its value in the scene. Returns false if there is
    /// none.
    bool set_factor(LightSources::Part part, std::uint32_t index, const glm::vec3& factor);
    /// The factor of an emitter; 1 if there is none.
    glm::vec3 factor(LightSources::Part part, std::uint32_t index) const;
    /// Recomputes a moved light. Requires that the sources are updated.
    void find_again(LightSources::Part part, std::uint32_t index);
    /// Updates the sources of moved surfaces. Requires that the sources are updated.
    void place();
    /// Recomputes the light of these lumels that an object's move from box `before` can change.
    /// Call after place(). After all lumels, light equals that of a new LightGroups. Returns the
    /// number of (lumel, group) pairs recomputed.
    std::uint64_t follow(std::uint32_t thing, const Box& before, std::size_t first,
                         std::size_t last);

    /// Σ over groups [N] [lx].
    const std::vector<glm::vec3>& sum();
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
        /// [N] [lx] of one emitter at factor 1; of several, at theirs
        std::vector<glm::vec3> light;

        bool is_shared() const { return senders.size() > 1; }
    };

    void list_senders();
    void add_groups();
    std::uint32_t sender_of(LightSources::Part part, std::uint32_t index) const;
    void find(Group& group);
    glm::vec3 light_of(const Group& group, std::size_t lumel) const;
    glm::vec3 light_of(const Emitter& sender, std::size_t lumel) const;
    glm::vec3 by_one(std::uint32_t source, std::uint32_t stream, std::size_t lumel) const;
    glm::vec3 by_many(const Emitter& sender, std::uint32_t stream, std::size_t lumel) const;
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
