// H = ∫ L cosθ dω of a lumel, by R rays of density cosθ / π from points x on it:
//
//     H ≈ 1/R Σ π L = 1/R Σ (B of the surface hit, or π L of the sky) + lamps.
//
// The terms are summed by instance, by grid cell of the hit, and by the cube side that the surface
// faces there.

#include "results/measure/contributors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "atlas/near/hit_lumels.h"
#include "atlas/near/world_lumels.h"
#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "lights/shadow_rays.h"
#include "rays/paths/directions.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();
/// Samples of a lamp, over the lumel and the lamp's disc.
constexpr std::uint32_t kLampPoints = 256;
/// Dimension pairs of a ray's random numbers.
constexpr std::uint32_t kPointPair = 0, kSenderDirectionPair = 1, kSenderSeedPair = 2;

/// Instance, cell, side of a cube.
using Place = std::array<std::int64_t, 5>;

/// Light of one contributor, and sums weighted by its luminance.
struct Sum {
    glm::vec3 light{0.0f}, place{0.0f};
    double weight = 0.0, distance = 0.0;
    std::map<int, double> materials;

    void add(const glm::vec3& more, const glm::vec3& at, float far, int material)
    {
        const double bright = luminance(more);
        light += more;
        place += float(bright) * at;
        distance += bright * double(far);
        weight += bright;
        materials[material] += bright;
    }
    int material() const
    {
        return std::max_element(materials.begin(), materials.end(),
                                [](const auto& a, const auto& b) { return a.second < b.second; })
            ->first;
    }
};

/// Luminance of equally weighted samples.
struct Moments {
    double sum = 0.0, squares = 0.0;
    void add(double value)
    {
        sum += value;
        squares += value * value;
    }
    /// Square of the standard error of the mean of `count` samples; what was not added is 0.
    double variance_of_mean(double count) const
    {
        const double mean = sum / count;
        return std::max(squares / count - mean * mean, 0.0) / count;
    }
};

class SenderSearch {
public:
    SenderSearch(const SolveScene& scene, std::span<const glm::vec3> irradiance,
                 std::uint32_t lumel, const SenderOptions& options)
        : scene_(scene.scene),
          rays_(scene.rays),
          lumels_(scene.lumels),
          irradiance_(irradiance),
          lumel_(lumel),
          options_(options),
          world_(scene.scene, scene.rays, scene.lumels),
          hits_(scene.scene, scene.atlas, scene.lumels),
          lamps_(scene.scene, scene.surfaces, scene.extent(), kLampsAlone),
          cell_(scene.extent() / options.cells)
    {
    }

    Senders find()
    {
        for (std::uint32_t k = 0; k < options_.rays; ++k)
            follow(PathSamples(options_.seed, k));
        Senders senders;
        for (const auto& [place, sum] : surfaces_)
            senders.list.push_back(surface(place, sum));
        if (sky_ != glm::vec3(0.0f))
            senders.list.push_back({.kind = Contributor::Kind::sky, .light = sky_});
        add_lamps(senders);
        for (const Contributor& sender : senders.list)
            senders.light += sender.light;
        std::stable_sort(senders.list.begin(), senders.list.end(),
                         [](const Contributor& a, const Contributor& b) {
                             return luminance(a.light) > luminance(b.light);
                         });
        senders.noise = std::sqrt(variance_ + ray_light_.variance_of_mean(options_.rays));
        senders.density = density();
        return senders;
    }

private:
    LumelPoint start(const PathSamples& samples) const
    {
        LumelPoint point = world_.point_on(lumel_, samples.stratified(kPointPair));
        point.position += world_[lumel_].ray_offset * point.normal;
        return point;
    }

    Place place_of(std::uint32_t instance, const glm::vec3& at, const glm::vec3& normal) const
    {
        const glm::vec3 cell = glm::floor((at - rays_.low()) / cell_);
        return {instance, std::int64_t(cell.x), std::int64_t(cell.y), std::int64_t(cell.z),
                cube_side(normal)};
    }

    glm::vec3 sent_by(std::uint32_t i) const
    {
        const Lumel& lumel = lumels_.lumels[i];
        return (lumel.flags & kLumelBuried) ? glm::vec3(0.0f)
                                            : lumel.emission + lumel.albedo * irradiance_[i];
    }

    void follow(const PathSamples& samples)
    {
        const LumelPoint point = start(samples);
        const glm::vec2 disc = square_to_disc(samples.stratified(kSenderDirectionPair));
        const float up = std::sqrt(std::max(1.0f - glm::dot(disc, disc), 0.0f));
        const glm::vec3 direction = turn_to(point.normal, disc.x, disc.y, up);
        const float share = 1.0f / float(options_.rays);
        RayHit hit;
        if (!rays_.closest(point.position, direction, 0.0f, kFar, samples.bits(kSenderSeedPair),
                           hit)) {
            const glm::vec3 light = kPi * hit.tint * sky_radiance(scene_.sky, direction);
            ray_light_.add(luminance(light));
            sky_ += share * light;
            return;
        }
        const std::uint32_t met = hits_.lumel(hit);
        const glm::vec3 light =
            met == HitLumels::kNone ? glm::vec3(0.0f) : share * hit.tint * sent_by(met);
        if (light == glm::vec3(0.0f))
            return;
        ray_light_.add(luminance(light) / share);
        const WorldLumel& there = world_[met];
        const Mesh& mesh = scene_.meshes[std::size_t(scene_.instances[hit.instance].mesh)];
        surfaces_[place_of(hit.instance, there.centre, there.normal)].add(
            light, point.position + hit.distance * direction, hit.distance,
            mesh.primitives[hit.primitive].material);
    }

    static Contributor surface(const Place& place, const Sum& sum)
    {
        return {.index = std::uint32_t(place[0]),
                .material = sum.material(),
                .place = sum.place / float(sum.weight),
                .distance = float(sum.distance / sum.weight),
                .light = sum.light};
    }

    void add_lamps(Senders& senders)
    {
        for (std::size_t l = 0; l < lamps_.count(); ++l) {
            const glm::vec3 light = light_of(l);
            if (light == glm::vec3(0.0f))
                continue;
            const LightSources::SourceInfo lamp = lamps_.origin(l);
            Contributor& sender = senders.list.emplace_back(
                Contributor{.kind = Contributor::Kind::lamp, .index = lamp.index, .light = light});
            if (!lamp.sun) {
                sender.place = lamp.centre;
                sender.distance = glm::distance(sender.place, world_[lumel_].centre);
            }
        }
    }

    glm::vec3 light_of(std::size_t lamp)
    {
        glm::vec3 sum(0.0f);
        Moments moments;
        for (std::uint32_t k = 0; k < kLampPoints; ++k) {
            const PathSamples samples(options_.seed, k);
            const LumelPoint point = start(samples);
            const RayOrigin origin = origin_at(point.position, point.normal);
            const SourceSample sample =
                lamps_.sample(lamp, origin, samples.stratified(kSenderDirectionPair));
            const glm::vec3 light =
                transmittance_to(rays_, sample, origin, samples.bits(kSenderSeedPair)) *
                sample.irradiance;
            sum += light;
            moments.add(luminance(light));
        }
        variance_ += moments.variance_of_mean(kLampPoints);
        return sum / float(kLampPoints);
    }

    /// Light per area of the lumels in a lumel's cell.
    std::vector<float> density() const
    {
        std::vector<Place> places;
        std::map<Place, double> areas;
        for (std::uint32_t i = 0; i < lumels_.lumels.size(); ++i) {
            const WorldLumel& there = world_[i];
            places.push_back(place_of(lumels_.lumels[i].instance, there.centre, there.normal));
            if (!(lumels_.lumels[i].flags & kLumelBuried))
                areas[places.back()] += double(lumels_.lumels[i].area);
        }
        std::vector<float> density;
        for (const Place& place : places) {
            const auto sender = surfaces_.find(place);
            density.push_back(
                sender == surfaces_.end() ? 0.0f : float(sender->second.weight / areas[place]));
        }
        return density;
    }

    const Scene& scene_;
    const RayScene& rays_;
    const Lumels& lumels_;
    std::span<const glm::vec3> irradiance_;
    std::uint32_t lumel_;
    const SenderOptions& options_;
    WorldLumels world_;
    HitLumels hits_;
    LightSources lamps_;
    float cell_;  ///< side [m]
    std::map<Place, Sum> surfaces_;
    glm::vec3 sky_{0.0f};
    Moments ray_light_;      ///< of surfaces and sky, per ray [lx]
    double variance_ = 0.0;  ///< of the light of lamps [lx²]
};

}  // namespace

Senders find_senders(const SolveScene& scene, std::span<const glm::vec3> irradiance,
                     std::uint32_t lumel, const SenderOptions& options)
{
    return SenderSearch(scene, irradiance, lumel, options).find();
}

}  // namespace lumel
