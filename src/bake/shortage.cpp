#include "bake/shortage.h"

#include <fmt/format.h>

#include "bake/stages.h"

namespace lumel {

std::string shortage(std::uint64_t needed_bytes, const gpu::DeviceInfo& device,
                     std::uint64_t host_bytes)
{
    const bool of_host = device.type == "cpu";
    const std::uint64_t free = of_host ? host_bytes : device.memory_bytes;
    if (free == 0 || needed_bytes <= free)
        return {};
    return fmt::format("a bake needs about {} of graphics memory, but {} has {}; use a smaller "
                       "--size or fewer --texels-per-metre",
                       memory_text(needed_bytes), of_host ? "this machine" : device.name,
                       memory_text(free));
}

}  // namespace lumel
