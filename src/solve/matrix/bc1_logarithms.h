#pragma once
// BC1 blocks whose texels are logarithms: as near as possible to what these stand for.

#include "solve/matrix/block_codes.h"

namespace lumel {

/// Encodes blocks of codes ln(v) 255 / offset + 255. The sum of squared errors of the entries v is
/// made small, not that of their codes: an error of a code weighs in proportion to the entry. A
/// block may have a fourth colour for entries that are 0 (DXT1's black).
class LogarithmsInBc1 {
public:
    /// largest: of each channel, what the code 255 stands for.
    LogarithmsInBc1(float offset, const std::array<float, 3>& largest);

    BlockWords encode(const ColorBlock& codes) const;

private:
    struct Ends;

    Ends refined(const ColorBlock& entries, Ends ends) const;
    float error_of(const ColorBlock& entries, const Ends& ends,
                   std::array<std::uint32_t, kBlockTexels>* indices = nullptr) const;
    /// v / largest of its channel
    float entry_of(float code) const;

    float step_;  ///< of ln(v) from one code to the next
    float offset_;
    std::array<float, 3> scale_;  ///< of the channels' largest
    /// Of codes in sixths, which all mixtures of two codes are.
    std::array<float, 255 * 6 + 1> entry_;
};

}  // namespace lumel
