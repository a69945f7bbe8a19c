#include "links/trace/link_casters.h"

#include "base/core/error.h"
#include "base/core/log.h"
#include "rays/device/device_caster.h"

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

/// Than the host is at casting rays.
bool is_faster(const std::string& device_type)
{
    return !device_type.empty() && device_type != "cpu";
}

std::unique_ptr<RayCaster> caster_for(const gpu::Device& device, const RayScene& rays, Rays wanted)
{
    if (wanted == Rays::query)
        return cast_by_queries(device, rays);
    if (wanted == Rays::tree)
        return cast_by_tree(device, rays);
    const auto make = [&] {
        return device.can_query_rays() ? cast_by_queries(device, rays) : cast_by_tree(device, rays);
    };
    if (wanted == Rays::automatic && is_faster(device.info().type))
        if (auto on_device = unless_refused(make))
            return on_device;
    return cast_on_host(rays);
}

}  // namespace

LinkWork::Casters casters_for(const gpu::Device* device, const RayScene& rays, Rays wanted)
{
    if (!device) {
        if (wanted != Rays::automatic && wanted != Rays::host)
            throw Error(ErrorKind::device, "--rays",
                        "needs a device for rays that are not \"host\"");
        return {.rays = cast_on_host(rays)};
    }
    return {.rays = caster_for(*device, rays, wanted),
            .bundles =
                wanted == Rays::raster ? std::make_unique<BundleCaster>(*device, rays) : nullptr};
}

std::uint64_t caster_bytes(const std::string& device, const RayScene& rays, Rays wanted)
{
    const bool casts = wanted == Rays::query || wanted == Rays::tree ||
                       (wanted == Rays::automatic && is_faster(device));
    return casts ? device_rays_bytes(rays) : 0;
}

}  // namespace lumel
