#include "raster/near/near_rows.h"

#include "base/core/dispatch.shared.h"

namespace lumel {
namespace {

/// Row starts; without a near field all rows are empty.
std::vector<std::uint32_t> starts_of(const NearField& near, std::size_t count)
{
    return near.first.size() == count + 1 ? near.first : std::vector<std::uint32_t>(count + 1, 0);
}

}  // namespace

NearRows::NearRows(const gpu::Device& device, const NearField& near, std::size_t lumel_count)
    : device_(&device),
      count_(std::uint32_t(lumel_count)),
      first_(device, starts_of(near, lumel_count)),
      column_(device, near.column),
      factor_(device, near.factor),
      kernel_(device)
{
}

std::uint64_t NearRows::device_bytes(std::size_t lumel_count, std::uint64_t pairs)
{
    return (lumel_count + 1) * sizeof(std::uint32_t) +
           pairs * (sizeof(std::uint32_t) + sizeof(float));
}

void NearRows::replace(const NearField& near)
{
    first_ = gpu::Array<std::uint32_t>(*device_, starts_of(near, count_));
    column_ = gpu::Array<std::uint32_t>(*device_, near.column);
    factor_ = gpu::Array<float>(*device_, near.factor);
}

void NearRows::light(gpu::Commands& commands, const gpu::Array<glm::vec3>& source,
                     const gpu::Array<glm::vec3>& result) const
{
    commands.dispatch(
        kernel_,
        {.first = first_, .column = column_, .factor = factor_, .source = source, .near = result},
        CountParams{count_}, count_);
}

}  // namespace lumel
