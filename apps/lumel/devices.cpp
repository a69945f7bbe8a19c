// lumel devices: what Vulkan offers, and why a device cannot be used.

#include <fmt/core.h>

#include "base/core/error.h"
#include "base/json/json_file.h"
#include "commands.h"
#include "gpu/device.h"
#include "links/trace/link_casters.h"

namespace lumel {
namespace {

constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;

/// The backend of --rays auto, with the reason.
std::string rays_text(const gpu::DeviceInfo& device)
{
    if (automatic_rays(device) == Rays::query)
        return "query, as it has ray queries";
    return device.type == "cpu" ? "host, as the device is a CPU"
                                : "host, as it has no ray queries (VK_KHR_ray_query)";
}

void print_json(const std::vector<gpu::DeviceInfo>& devices)
{
    Json list = Json::array();
    for (std::size_t index = 0; index < devices.size(); ++index) {
        const gpu::DeviceInfo& device = devices[index];
        list.push_back({{"index", index},
                        {"name", device.name},
                        {"type", device.type},
                        {"vulkan", device.api_version},
                        {"driver", device.driver},
                        {"memory_bytes", device.memory_bytes},
                        {"ray_queries", device.ray_queries},
                        {"usable", device.usable},
                        {"reason", device.reason}});
    }
    fmt::print("{}", json_text(list));
}

void print_table(const std::vector<gpu::DeviceInfo>& devices)
{
    for (std::size_t index = 0; index < devices.size(); ++index) {
        const gpu::DeviceInfo& device = devices[index];
        fmt::print("{}  {}\n   {}, Vulkan {}, {:.1f} GiB, driver {}\n", index, device.name,
                   device.type, device.api_version,
                   static_cast<double>(device.memory_bytes) / kGibibyte, device.driver);
        if (device.usable)
            fmt::print("   --rays auto: {}\n", rays_text(device));
        else
            fmt::print("   cannot be used: {}\n", device.reason);
    }
}

}  // namespace

int run(const DevicesArguments& arguments)
{
    const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
    if (arguments.json)
        print_json(devices);
    else
        print_table(devices);
    if (devices.empty())
        throw Error(
            ErrorKind::device, "",
            "Vulkan offers no device; install a driver (mesa-vulkan-drivers has a software one)");
    return kExitDone;
}

}  // namespace lumel
