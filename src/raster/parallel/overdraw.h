#pragma once
// Estimates the number of overlapping surfaces per pixel from their random depths.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include <cstdint>
#include <span>

#include "gpu/commands.h"

namespace lumel {

/// Counts the surfaces that compete for the pixels of stochastic maps, without a pass of its own.
/// The largest of K random numbers in 0…1, z, stays, and -ln z is exponentially distributed with
/// mean 1/K. Its sum over m pixels of equal K has a gamma distribution, whose inverse has the mean
/// K/(m - 1). So (m - 1)/Σ -ln z is an unbiased estimate where K is constant, as is assumed of
/// small blocks of pixels; [TN11] section 6 assumes it of the lookups.
class Overdraw {
public:
    /// Adds an area of a depth image `width` pixels wide. Depth 0: pixel not covered.
    void add(std::span<const float> depths, std::uint32_t width, const gpu::Area& area);

    /// K, averaged over the covered pixels; 0 if there are none.
    double mean() const { return pixels_ > 0.0 ? surfaces_ / pixels_ : 0.0; }

private:
    double surfaces_ = 0.0, pixels_ = 0.0;
};

}  // namespace lumel
