#pragma once
// Inputs of all stages of the link engine: constant but for the sources of light.

#include <memory>
#include <vector>

#include "atlas/cells/cells.h"
#include "atlas/cells/ray_origins.h"
#include "atlas/lumels/sample_rule.h"
#include "atlas/prepare/solve_scene.h"
#include "base/ranks/ranks.h"
#include "lights/sources.h"
#include "rays/device/bundle_caster.h"

namespace lumel {

/// Must not move.
struct LinkWork {
    /// Ray tracing of the scene's geometry.
    struct Casters {
        std::unique_ptr<RayCaster> rays;
        std::unique_ptr<BundleCaster> bundles = nullptr;  ///< of shared directions; null: `rays`
        const gpu::Device* device = nullptr;              ///< casts `rays`; null: the CPU does
    };
    /// Returns the lumels [N] in the order in which they trace rays.
    using Order = std::vector<std::uint32_t> (*)(const WorldLumels& world);

    /// The scene and the ranks must outlive this, the scene unmoved. lights: that count as sources.
    /// shared_by: ranks that share the work, or null.
    LinkWork(const SolveScene& of, Casters by, SampleRule rule, Order order_of,
             const LightSelection& lights = {}, Ranks* shared_by = nullptr)
        : scene(of),
          casters(std::move(by)),
          world(of.scene, of.rays, of.lumels),
          cells(world),
          starts(world, &cells, rule == SampleRule::centre),
          sources(of.scene, of.surfaces, of.extent(), lights),
          order(order_of(world)),
          ranks(shared_by),
          host_(cast_on_host(of.rays))
    {
    }
    LinkWork(const LinkWork&) = delete;
    LinkWork& operator=(const LinkWork&) = delete;

    const std::vector<Lumel>& lumels() const { return scene.lumels.lumels; }
    const RayCaster& caster() const { return *casters.rays; }  ///< of rays in large numbers
    /// Casts reflected rays, which are few, on the CPU: a round trip to a GPU takes longer.
    const RayCaster& caster_of_few() const { return *host_; }
    bool is_buried(std::size_t lumel) const { return (lumels()[lumel].flags & kLumelBuried) != 0; }

    const SolveScene& scene;
    const Casters casters;
    const WorldLumels world;
    const Cells cells;
    const RayOrigins starts;
    LightSources sources;                    ///< LightSources::find() after changes of light
    const std::vector<std::uint32_t> order;  ///< [N]
    Ranks* ranks;                            ///< that share rays and sweeps; null: none

private:
    const std::unique_ptr<RayCaster> host_;
};

}  // namespace lumel
