#pragma once
// Light of an animation, by one of the interactive methods.

#include <memory>

#include "jobs/play/play.h"
#include "results/record/report.h"
#include "scene/values/animation.h"

namespace lumel {

class PlayedLight {
public:
    virtual ~PlayedLight() = default;

    /// Requests the light of the scene `shown`, at a time of the animation [s].
    virtual void change_to(const Scene& shown, double time) = 0;
    /// Runs for about `budget_ms` or until converged; records cost and residual in `row`.
    virtual void update(double budget_ms, FrameRow& row) = 0;
    /// H [N] [lx]
    virtual std::vector<glm::vec3> irradiance() = 0;

    /// Total of hemicubes, directions or rays.
    virtual std::uint64_t shots() const = 0;
    virtual const Scene& scene() const = 0;
    virtual const Atlas& atlas() const = 0;
    virtual const Lumels& lumels() const = 0;
    /// The lumels of irradiance(), of which moved objects may bury some.
    virtual Lumels shown_lumels() const { return lumels(); }
    virtual const gpu::StageTimes& times() const = 0;
};

/// Light by the method of the options. start: the first frame. The device and the animation must
/// outlive this. Throws Error{input} if the method does not support the animation.
std::unique_ptr<PlayedLight> make_played_light(const gpu::Device& device, const Scene& start,
                                               const Animation& animation,
                                               const PlayOptions& options);

/// Emission at `time` relative to its maximum over the animation, which live scenes are built with.
glm::vec3 emission_factor(const AnimatedMaterial& material, double time);
Scene at_its_brightest(Scene scene, const Animation& animation);

/// True if any visible object moves or any lamp changes.
bool changes_anything(const Scene& start, const Animation& animation);

}  // namespace lumel
