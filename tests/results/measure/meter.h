#pragma once
// A light meter in a scene of quads whose lumels have one irradiance all over.

#include <numbers>
#include <vector>

#include "../../support/box_lumels.h"
#include "results/measure/light_meter.h"
#include "results/measure/light_probe.h"

namespace lumel::test {

/// 0.5 %, the accuracy that is asked of a reading.
inline constexpr double kAccuracy = 0.005;
inline constexpr std::uint32_t kManyRays = 1 << 16;
inline constexpr double kPi = std::numbers::pi;
/// A scene has nothing beside its quads.
inline constexpr auto kNothingElse = [](Scene&) {};

/// A rectangle that faces down, over x and z from its corner.
inline support::Quad panel(const glm::vec3& corner, float width, float depth, float albedo,
                           float emission = 0.0f)
{
    return {.corner = corner,
            .edge_u = {width, 0.0f, 0.0f},
            .edge_v = {0.0f, 0.0f, depth},
            .albedo = glm::vec3(albedo),
            .emission = glm::vec3(emission)};
}

class MeteredRoom {
public:
    /// irradiance: of all lumels [lx]. `add`: what the scene has beside the quads.
    template <class Add>
    MeteredRoom(const std::vector<support::Quad>& quads, float irradiance, const Add& add)
        : made_(support::make_quads(quads)),
          atlas_(support::lay_out(made_, quads)),
          irradiance_(made_.lumels.lumels.size(), glm::vec3(irradiance))
    {
        add(made_.scene);
        for (std::size_t i = quads.size(); i < made_.scene.instances.size(); ++i)
            leave_dark(std::uint32_t(i));
    }

    Reading read(const MeterPoint& point, std::uint32_t samples = kManyRays,
                 std::uint32_t seed = 1) const
    {
        const RayScene rays(made_.scene);
        const LightMeter meter(made_.scene, rays, atlas_, made_.lumels, irradiance_,
                               {.samples = samples, .seed = seed});
        return meter.read(point, 0);
    }

    /// [lamps] shares: of each lamp in the light of all lumels.
    std::vector<double> read_lamps(const MeterPoint& point, const std::vector<float>& shares) const
    {
        const RayScene rays(made_.scene);
        const LightMeter meter(made_.scene, rays, atlas_, made_.lumels, irradiance_,
                               {.samples = kManyRays});
        LampShares lamps{.lamps = find_lamps(made_.scene, made_.lumels, meter.sources(),
                                             std::span<const LampGroup>())};
        for (const float share : shares)
            lamps.of_lumels.emplace_back(irradiance_.size(), glm::vec3(share));
        return meter.read_lamps(point, 0, lamps).lux;
    }

    ProbeLight probe(const glm::vec3& position, std::uint32_t samples = kManyRays) const
    {
        const RayScene rays(made_.scene);
        const LightProbe probe(made_.scene, rays, atlas_, made_.lumels, irradiance_,
                               {.samples = samples});
        return probe.read(position, 0);
    }

private:
    /// A mesh beside the quads: a row of the map in which there are no lumels.
    void leave_dark(std::uint32_t instance)
    {
        const Primitive& primitive = made_.scene.meshes[instance].primitives.front();
        Surface surface{.instance = instance, .indices = primitive.indices};
        for (std::uint32_t v = 0; v < primitive.positions.size(); ++v) {
            surface.source_vertex.push_back(v);
            surface.texcoord.emplace_back(0.5f, float(atlas_.height) + 0.5f);
        }
        surface.chart.assign(primitive.indices.size() / 3, atlas_.chart_count++);
        atlas_.surfaces.push_back(std::move(surface));
        made_.lumels.height = ++atlas_.height;
        made_.lumels.coverage.resize(made_.lumels.coverage.size() + std::size_t(atlas_.width));
    }

    support::HandMade made_;
    Atlas atlas_;
    std::vector<glm::vec3> irradiance_;
};

}  // namespace lumel::test
