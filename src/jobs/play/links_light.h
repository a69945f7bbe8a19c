#pragma once
// Light of an animation over links.

#include "jobs/play/played_light.h"
#include "links/live/live_links.h"

namespace lumel {

/// Instances that move as one: a list for each animated node, of those below it without animated
/// nodes between.
std::vector<std::vector<std::uint32_t>> moving_together(const Scene& scene,
                                                        const Animation& animation);

class LinksLight final : public PlayedLight {
public:
    /// Traces all links. Throws as LiveLinks does.
    LinksLight(const Scene& start, const Animation& animation, const PlayOptions& options);

    void change_to(const Scene& shown, double time) override;
    void update(double budget_ms, FrameRow& row) override;
    std::vector<glm::vec3> irradiance() override { return live_.shown(); }

    std::uint64_t shots() const override;
    const Scene& scene() const override { return live_.scene(); }
    const Atlas& atlas() const override { return live_.atlas(); }
    const Lumels& lumels() const override { return live_.lumels(); }
    Lumels shown_lumels() const override { return live_.shown_lumels(); }
    const gpu::StageTimes& times() const override { return times_; }

private:
    bool bake(double budget_ms);

    std::vector<glm::mat4> start_;                    ///< [instances] transforms of the first frame
    std::vector<AnimatedMaterial> lamps_;             ///< those with animated emission
    std::vector<std::vector<std::uint32_t>> groups_;  ///< instances that move together
    const LinksOptions links_;
    const double bake_error_;
    LiveLinks live_;
    std::optional<BakeAside> bake_;  ///< of the present frame
    gpu::StageTimes times_;          ///< none: runs on the CPU
    LiveLinksState state_;
};

}  // namespace lumel
