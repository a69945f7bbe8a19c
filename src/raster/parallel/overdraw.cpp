#include "raster/parallel/overdraw.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Block side [pixels].
constexpr std::uint32_t kBlock = 4;
/// Minimum covered pixels of a block: with fewer, the estimate's variance, K²/(m - 2), is infinite
/// or large.
constexpr std::uint32_t kMinPixels = 4;

/// Sums over the pixels of a block.
struct Block {
    double sum = 0.0;  ///< Σ -ln z
    std::uint32_t covered = 0;
};

Block block_at(std::span<const float> depths, std::uint32_t width, const gpu::Area& block)
{
    Block found;
    for (std::uint32_t y = block.y; y < block.y + block.height; ++y)
        for (std::uint32_t x = block.x; x < block.x + block.width; ++x) {
            const float depth = depths[std::size_t(y) * width + x];
            if (depth <= 0.0f)
                continue;
            found.sum -= std::log(double(depth));
            ++found.covered;
        }
    return found;
}

}  // namespace

void Overdraw::add(std::span<const float> depths, std::uint32_t width, const gpu::Area& area)
{
    for (std::uint32_t y = 0; y < area.height; y += kBlock)
        for (std::uint32_t x = 0; x < area.width; x += kBlock) {
            const Block block = block_at(depths, width,
                                         {area.x + x, area.y + y, std::min(kBlock, area.width - x),
                                          std::min(kBlock, area.height - y)});
            if (block.covered < kMinPixels || block.sum <= 0.0)
                continue;
            const auto covered = double(block.covered);
            surfaces_ += covered * (covered - 1.0) / block.sum;
            pixels_ += covered;
        }
}

}  // namespace lumel
