#include "links/trace/link_casters.h"

#include "base/core/error.h"
#include "base/core/log.h"
#include "rays/device/device_caster.h"

namespace lumel {
namespace {

Rays chosen(const gpu::DeviceInfo& device, Rays wanted)
{
    return wanted == Rays::automatic ? automatic_rays(device) : wanted;
}

LinkWork::Casters caster_for(const gpu::Device& device, const RayScene& rays, Rays wanted)
{
    switch (chosen(device.info(), wanted)) {
    case Rays::query:
        return {.rays = cast_by_queries(device, rays), .device = &device};
    case Rays::tree:
        return {.rays = cast_by_tree(device, rays), .device = &device};
    case Rays::raster:
        return {.rays = cast_on_host(rays),
                .bundles = std::make_unique<BundleCaster>(device, rays)};
    default:
        return {.rays = cast_on_host(rays)};
    }
}

}  // namespace

Rays automatic_rays(const gpu::DeviceInfo& device)
{
    return device.ray_queries && device.type != "cpu" ? Rays::query : Rays::host;
}

LinkWork::Casters casters_for(const gpu::Device* device, const RayScene& rays, Rays wanted)
{
    if (!device) {
        if (wanted != Rays::automatic && wanted != Rays::host)
            throw Error(ErrorKind::device, "--rays",
                        "needs a device for rays that are not \"host\"");
        return {.rays = cast_on_host(rays)};
    }
    if (wanted == Rays::automatic)
        try {
            return caster_for(*device, rays, wanted);
        } catch (const Error& error) {
            log_info(std::string("tracing rays on the CPU: ") + error.what());
            return {.rays = cast_on_host(rays)};
        }
    return caster_for(*device, rays, wanted);
}

std::uint64_t caster_bytes(const gpu::DeviceInfo& device, const RayScene& rays, Rays wanted)
{
    const Rays by = chosen(device, wanted);
    return by == Rays::query || by == Rays::tree ? device_rays_bytes(rays) : 0;
}

}  // namespace lumel
