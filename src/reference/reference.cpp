// Irradiance is what white matte reflects; see path_tracer.cpp.

#include "reference/reference.h"

#include <algorithm>

#include "atlas/sampling.h"
#include "reference/averages.h"
#include "reference/path_tracer.h"

namespace lumel {

namespace {

/// Key of the random numbers of a map: those of pictures are independent.
constexpr std::uint32_t kMapKey = 0;

/// Points on lumels, in the world.
class LumelStarts {
public:
    LumelStarts(const Scene& scene, const Lumels& lumels, SampleRule rule, float lift)
        : lumels_(lumels),
          rule_(rule),
          lift_(lift)
    {
        for (const Instance& instance : scene.instances) {
            transforms_.push_back(instance.transform);
            normal_transforms_.push_back(
                glm::transpose(glm::inverse(glm::mat3(instance.transform))));
        }
    }

    /// Steps onto a lumel. `at` in the unit square chooses where.
    PathVertex start(const Lumel& lumel, const glm::vec2& at) const;

private:
    const Lumels& lumels_;
    SampleRule rule_;
    float lift_;  ///< [m]
    std::vector<glm::mat4> transforms_;
    std::vector<glm::mat3> normal_transforms_;
};

PathVertex LumelStarts::start(const Lumel& lumel, const glm::vec2& at) const
{
    glm::vec3 position = lumel.position;
    glm::vec3 normal = lumel.normal;
    glm::vec3 geometric = lumel.normal;
    if (rule_ == SampleRule::area) {
        const LumelPoint point = point_on(lumels_, lumel, at.x, at.y);
        position = point.position;
        normal = point.normal;
        std::uint32_t piece = lumel.first_piece;
        while (piece + 1 < lumel.first_piece + lumel.piece_count &&
               at.x >= lumels_.pieces[piece].share)
            ++piece;
        geometric = glm::cross(lumels_.pieces[piece].edge_u, lumels_.pieces[piece].edge_v);
    }
    const glm::mat3& normal_transform = normal_transforms_[lumel.instance];
    geometric = glm::normalize(normal_transform * geometric);
    // Lean towards the middle too, so that no start lies behind a wall that touches the lumel.
    const glm::mat4& transform = transforms_[lumel.instance];
    const glm::vec3 world(transform * glm::vec4(position, 1.0f));
    const glm::vec3 inward = glm::vec3(transform * glm::vec4(lumel.position, 1.0f)) - world;
    const float distance = glm::length(inward);
    glm::vec3 lifted = world + lift_ * geometric;
    if (distance > 0.0f)
        lifted += inward * (std::min(lift_, 0.5f * distance) / distance);
    return {lifted, geometric, Brdf(glm::normalize(normal_transform * normal))};
}

}  // namespace

std::vector<glm::vec3> reference_irradiance(const Scene& scene, const RayScene& rays,
                                            const Lumels& lumels, const ReferenceOptions& options,
                                            const std::function<bool(double)>& progress)
{
    const PathTracer tracer(scene, rays, options.max_bounces, options.parts);
    const LumelStarts starts(scene, lumels, options.rule, tracer.lift());
    const std::uint32_t key = PathSamples::hash(options.seed, kMapKey);
    const auto estimate = [&](std::size_t i, std::uint32_t sample) {
        const Lumel& lumel = lumels.lumels[i];
        if (lumel.flags & kLumelBuried)
            return glm::vec4(0.0f);
        const PathSamples samples(PathSamples::hash(key, std::uint32_t(i)), sample);
        const PathVertex vertex = starts.start(lumel, samples.stratified(kStartPair));
        return glm::vec4(tracer.reflected(vertex, samples), 0.0f);
    };
    const std::vector<glm::vec4> means =
        average(lumels.lumels.size(), options.samples_per_lumel, estimate, progress);
    return {means.begin(), means.end()};
}

}  // namespace lumel
