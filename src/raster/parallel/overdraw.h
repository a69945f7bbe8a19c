#pragma once
// The number of surfaces behind one another, estimated from the random depths that they were given.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include <cstdint>
#include <span>

#include "gpu/commands.h"

namespace lumel {

/// A count of the surfaces that competed for the pixels of stochastic maps, for which no pass is
/// needed. Of K random numbers in 0…1 the largest, z, stays, and -ln z is then distributed
/// exponentially with mean 1/K. Its sum over m pixels of one K follows a gamma distribution, of
/// whose inverse the mean is K/(m - 1). So (m - 1)/Σ -ln z is K without bias where K is constant,
/// which is assumed of small blocks of pixels, as [TN11] section 6 does of the lookups.
class Overdraw {
public:
    /// Adds an area of an image of depths, `width` pixels wide; 0: the pixel is not covered.
    void add(std::span<const float> depths, std::uint32_t width, const gpu::Area& area);

    /// K, mean over the covered pixels that were added; 0 if there are none.
    double mean() const { return pixels_ > 0.0 ? surfaces_ / pixels_ : 0.0; }

private:
    double surfaces_ = 0.0, pixels_ = 0.0;
};

}  // namespace lumel
