#include "links/trace/link_casters.h"

#include "base/core/error.h"
#include "base/core/log.h"
#include "rays/device/query_caster.h"

namespace lumel {
namespace {

/// The result of `make`; null, with a debug message, if the device does not support it.
template <class Make>
auto unless_refused(const Make& make) -> decltype(make())
{
    try {
        return make();
    } catch (const Error& error) {
        log_info(std::string("tracing rays on the CPU: ") + error.what());
        return nullptr;
    }
}

std::unique_ptr<BundleCaster> bundles_for(const gpu::Device& device, const RayScene& rays,
                                          Rays wanted)
{
    const auto make = [&] { return std::make_unique<BundleCaster>(device, rays); };
    if (wanted == Rays::raster)
        return make();
    const bool draws = !device.can_query_rays() && device.info().type != "cpu";
    return wanted == Rays::automatic && draws ? unless_refused(make) : nullptr;
}

std::unique_ptr<RayCaster> caster_for(const gpu::Device& device, const RayScene& rays, Rays wanted)
{
    const auto make = [&] { return cast_by_queries(device, rays); };
    if (wanted == Rays::query)
        return make();
    if (wanted == Rays::automatic && device.can_query_rays() && device.info().type != "cpu")
        if (auto queries = unless_refused(make))
            return queries;
    return cast_on_host(rays);
}

}  // namespace

LinkWork::Casters casters_for(const gpu::Device* device, const RayScene& rays, Rays wanted)
{
    if (!device) {
        if (wanted == Rays::query || wanted == Rays::raster)
            throw Error(ErrorKind::device, "--rays",
                        "needs a device for rays that are not \"host\"");
        return {.rays = cast_on_host(rays)};
    }
    return {.rays = caster_for(*device, rays, wanted),
            .bundles = bundles_for(*device, rays, wanted)};
}

}  // namespace lumel
