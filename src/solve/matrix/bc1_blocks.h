#pragma once
// Texture blocks as graphics hardware reads them: BC1 (DXT1), 4 × 4 texels of three channels.

#include <array>
#include <cstdint>

namespace lumel {

inline constexpr std::uint32_t kBlockSide = 4;
inline constexpr std::uint32_t kBlockTexels = kBlockSide * kBlockSide;

/// As they lie in memory: low word first.
using BlockWords = std::array<std::uint32_t, 2>;

/// Codes 0…255 [row][column][channel].
using ColorBlock = std::array<std::array<float, 3>, kBlockTexels>;

ColorBlock decode_bc1(const BlockWords& words);

/// Encodes blocks of logarithms: codes ln(v) 255 / offset + 255. Minimises the squared errors of
/// the entries v, not those of their codes: an error of a code weighs in proportion to the entry. A
/// block may have a fourth colour for entries that are 0 (DXT1's black).
class Bc1Encoder {
public:
    /// largest: of each channel, the entry of code 255.
    Bc1Encoder(float offset, const std::array<float, 3>& largest);

    BlockWords encode(const ColorBlock& codes) const;

private:
    struct Ends;

    Ends refined(const ColorBlock& entries, Ends ends) const;
    float error_of(const ColorBlock& entries, const Ends& ends, float limit,
                   std::uint32_t* indices) const;
    /// v / largest of its channel
    float entry_of(float code) const;

    float step_;  ///< ln(v) from one code to the next
    float offset_;
    std::array<float, 3> scale_;  ///< largest of each channel, relative to the largest of all
    /// Entry by code in sixths, in which all mixtures of two codes are whole.
    std::array<float, 255 * 6 + 1> entry_;
};

}  // namespace lumel
