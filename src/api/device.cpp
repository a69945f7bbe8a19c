#include "api/device.h"

#include "api/translate.h"
#include "lumel/vulkan.h"

namespace lumel::v0 {
namespace {

DeviceInfo info_of(const gpu::DeviceInfo& info)
{
    return {.name = info.name,
            .type = info.type,
            .api_version = info.api_version,
            .driver = info.driver,
            .memory_bytes = info.memory_bytes,
            .usable = info.usable,
            .reason = info.reason};
}

}  // namespace

DeviceImpl::DeviceImpl(const std::string& pick) : device(pick), info(info_of(device.info())) {}

DeviceImpl::DeviceImpl(const gpu::HostDevice& host) : device(host), info(info_of(device.info())) {}

std::vector<DeviceInfo> list_devices()
{
    return translated([] {
        std::vector<DeviceInfo> list;
        for (const gpu::DeviceInfo& info : gpu::list_devices())
            list.push_back(info_of(info));
        return list;
    });
}

Device::Device(const std::string& pick)
    : impl_(translated([&] { return std::make_unique<DeviceImpl>(pick); }))
{
}

Device::Device(std::unique_ptr<DeviceImpl> impl) : impl_(std::move(impl)) {}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const
{
    return impl_->info;
}

Device use_device(const HostDevice& host)
{
    return translated([&] {
        const gpu::HostDevice handles{.instance = host.instance,
                                      .physical = host.physical,
                                      .device = host.device,
                                      .queue = host.queue,
                                      .queue_family = host.queue_family,
                                      .tessellation = host.tessellation,
                                      .fragment_stores = host.fragment_stores,
                                      .block_textures = host.block_textures,
                                      .ray_queries = host.ray_queries};
        return Device(std::make_unique<DeviceImpl>(handles));
    });
}

}  // namespace lumel::v0
