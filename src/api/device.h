#pragma once

#include "gpu/device.h"
#include "lumel/lumel.h"

namespace lumel::v0 {

struct DeviceImpl {
    gpu::Device device;
    DeviceInfo info;

    explicit DeviceImpl(const std::string& pick);
    explicit DeviceImpl(const gpu::HostDevice& host);
};

}  // namespace lumel::v0
