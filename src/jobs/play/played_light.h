#pragma once
// The light of a scene that is played, by one of the methods that follow what changes.

#include <memory>

#include "jobs/play/play.h"
#include "results/record/report.h"
#include "scene/values/animation.h"

namespace lumel {

class PlayedLight {
public:
    virtual ~PlayedLight() = default;

    /// Asks for the light of the scene as `shown` has it, at a time of the animation [s].
    virtual void change_to(const Scene& shown, double time) = 0;
    /// Works for about so many milliseconds, or until at rest; adds to the row what that has found.
    virtual void update(double budget_ms, FrameRow& row) = 0;
    /// H [N] [lx]
    virtual std::vector<glm::vec3> irradiance() = 0;

    /// Hemicubes, directions or rays, so far.
    virtual std::uint64_t shots() const = 0;
    virtual const Scene& scene() const = 0;
    virtual const Atlas& atlas() const = 0;
    virtual const Lumels& lumels() const = 0;
    virtual const gpu::StageTimes& times() const = 0;
};

/// By the method of the options. start: as the first frame has it. The device and the animation
/// must outlive it. Throws Error{input} for what the method cannot follow.
std::unique_ptr<PlayedLight> make_played_light(const gpu::Device& device, const Scene& start,
                                               const Animation& animation,
                                               const PlayOptions& options);

/// What is emitted as a part of the most there will be, which live scenes are made with.
glm::vec3 emission_factor(const AnimatedMaterial& material, double time);
Scene at_its_brightest(Scene scene, const Animation& animation);

/// Does anything that is shown move, or any lamp change?
bool changes_anything(const Scene& start, const Animation& animation);

}  // namespace lumel
