#include "jobs/bake/seen_backs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "atlas/near/world_lumels.h"
#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Share of light or of a picture from which on backs are named.
constexpr double kMuchSeen = 0.3;
/// Rays per lamp and camera, lamps and cameras, and rays of all emissive lumels.
constexpr std::uint32_t kRays = 256;
constexpr std::size_t kMostLamps = 64, kMostCameras = 16, kOfLumels = 4096;
constexpr std::uint32_t kPair = 0;
constexpr float kAnyDistance = std::numeric_limits<float>::infinity();

/// Counts first hits on single-sided backs.
class FirstHits {
public:
    explicit FirstHits(const SolveScene& prepared)
        : prepared_(prepared),
          backs_(prepared.scene.instances.size(), 0.0)
    {
    }

    void cast(const glm::vec3& origin, const glm::vec3& direction, double weight)
    {
        RayHit hit;
        if (!(weight > 0.0) ||
            !prepared_.rays.closest(origin, direction, 0.0f, kAnyDistance, 0, hit))
            return;
        all_ += weight;
        const Scene& scene = prepared_.scene;
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
        const int material = mesh.primitives[hit.primitive].material;
        if (!hit.front && !scene.materials[std::size_t(material)].double_sided)
            backs_[hit.instance] += weight;
    }
    std::size_t most() const
    {
        return std::size_t(std::max_element(backs_.begin(), backs_.end()) - backs_.begin());
    }
    /// Of the object with most.
    double share() const { return all_ > 0.0 ? backs_[most()] / all_ : 0.0; }

private:
    const SolveScene& prepared_;
    std::vector<double> backs_;  ///< [instances]
    double all_ = 0.0;
};

/// Light of lamps and of emissive lumels [lm].
FirstHits hits_of_light(const SolveScene& prepared)
{
    FirstHits hits(prepared);
    const Scene& scene = prepared.scene;
    for (std::size_t l = 0; l < std::min(scene.lights.size(), kMostLamps); ++l) {
        const PunctualLight& light = scene.lights[l];
        if (light.kind == PunctualLight::Kind::directional)
            continue;
        for (std::uint32_t k = 0; k < kRays; ++k) {
            const glm::vec3 along = on_sphere(PathSamples(std::uint32_t(l), k).stratified(kPair));
            hits.cast(glm::vec3(light.transform[3]) + light.radius * along, along,
                      luminance(intensity_towards(scene, light, along)) * 4.0 * double(kPi) /
                          double(kRays));
        }
    }
    std::vector<std::size_t> emissive;
    for (std::size_t i = 0; i < prepared.lumels.lumels.size(); ++i)
        if (prepared.lumels.lumels[i].emission != glm::vec3(0.0f))
            emissive.push_back(i);
    if (emissive.empty())
        return hits;
    const WorldLumels world(scene, prepared.rays, prepared.lumels);
    const std::size_t step = emissive.size() / kOfLumels + 1;
    for (std::size_t n = 0; n < emissive.size(); n += step) {
        const std::size_t i = emissive[n];
        const glm::vec3 normal = world[i].normal;
        const glm::vec3 along =
            frame_about(normal) * by_cosine(PathSamples(0, std::uint32_t(n)).stratified(kPair));
        hits.cast(world[i].centre + prepared.rays.ray_offset(world[i].centre, normal) * normal,
                  along,
                  luminance(prepared.lumels.lumels[i].emission) *
                      double(world[i].size * world[i].size) * double(step));
    }
    return hits;
}

FirstHits hits_of_camera(const SolveScene& prepared, const Camera& camera)
{
    FirstHits hits(prepared);
    const auto at = [&](const glm::vec4& place) { return glm::vec3(camera.transform * place); };
    const float aspect = camera.aspect > 0.0f ? camera.aspect : 1.0f;
    const bool is_flat = camera.orthographic_height > 0.0f;
    const float half =
        is_flat ? 0.5f * camera.orthographic_height : std::tan(0.5f * camera.vertical_fov);
    for (std::uint32_t k = 0; k < kRays; ++k) {
        const glm::vec2 seen = 2.0f * PathSamples(0, k).stratified(kPair) - 1.0f;
        const glm::vec2 aside = half * seen * glm::vec2(aspect, 1.0f);
        const glm::vec4 from(is_flat ? aside : glm::vec2(0.0f), 0.0f, 1.0f);
        const glm::vec4 along(is_flat ? glm::vec2(0.0f) : aside, -1.0f, 0.0f);
        hits.cast(at(from), glm::normalize(at(along)), 1.0);
    }
    return hits;
}

}  // namespace

std::string of_seen_backs(const SolveScene& prepared)
{
    const auto sentence = [&](const FirstHits& hits, const char* what) -> std::string {
        const std::string& name = prepared.scene.instances[hits.most()].name;
        if (!(hits.share() > kMuchSeen) || name.empty())
            return {};
        return fmt::format("{:.0f} % of {} meets \"{}\" from behind, where it is black: turn its "
                           "faces round or make its material double-sided",
                           100.0 * hits.share(), what, name);
    };
    if (prepared.scene.instances.empty())
        return {};
    std::string found = sentence(hits_of_light(prepared), "the light of lamps");
    const std::vector<Camera>& cameras = prepared.scene.cameras;
    for (std::size_t c = 0; found.empty() && c < std::min(cameras.size(), kMostCameras); ++c)
        found = sentence(hits_of_camera(prepared, cameras[c]), "a camera's view");
    return found;
}

}  // namespace lumel
