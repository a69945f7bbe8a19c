#include <cassert>

#include "rays/cast/ray_caster.h"

namespace lumel {
namespace {

/// Data of this many rays fit in the caches of a core.
constexpr std::size_t kHostBatch = 256;

class HostCaster final : public RayCaster {
public:
    explicit HostCaster(const RayScene& rays) : rays_(rays) {}

    void closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const override
    {
        assert(rays.size() == hits.size());
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (!rays_.closest(rays[i], hits[i]))
                hits[i].distance = kNothing;
    }

    void transmittance(std::span<const RaySpan> rays,
                       std::span<glm::vec3> transmittance) const override
    {
        assert(rays.size() == transmittance.size());
        rays_.transmittance(rays, transmittance);
    }

    std::size_t batch() const override { return kHostBatch; }
    const char* name() const override { return "host"; }

private:
    const RayScene& rays_;
};

}  // namespace

std::unique_ptr<RayCaster> cast_on_host(const RayScene& rays)
{
    return std::make_unique<HostCaster>(rays);
}

}  // namespace lumel
