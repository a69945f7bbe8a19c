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

/// Bits of the channels of each texel whose error does not count.
using FreeChannels = std::array<std::uint8_t, kBlockTexels>;
inline constexpr std::uint8_t kFreeTexel = 7;

/// Error that each row has carried so far: Σ (entry − decoded), weighted by ρ^distance
/// [row][channel].
using RowErrors = std::array<std::array<float, 3>, kBlockSide>;

/// Encodes blocks of logarithms: codes ln(v) 255 / offset + 255. Minimises the squared errors of
/// the entries v, not those of their codes: an error of a code weighs in proportion to the entry. A
/// block may have a fourth colour for entries that are 0 (DXT1's black).
class Bc1Encoder {
public:
    /// largest: of each channel, the entry of code 255.
    Bc1Encoder(float offset, const std::array<float, 3>& largest);

    /// free: channels that do not count. carried: unless null, texels make up for the errors of
    /// their row so far, which are updated. So errors of entries cancel in the light.
    BlockWords encode(const ColorBlock& codes, const FreeChannels& free = {},
                      RowErrors* carried = nullptr) const;

private:
    struct Ends;

    /// Entries and what their errors count, 1 or 0.
    struct Wanted;

    Ends refined(const Wanted& wanted, Ends ends) const;
    std::array<std::array<float, 3>, 4> palette_of(const Ends& ends) const;
    float error_of(const Wanted& wanted, const Ends& ends, float limit) const;
    std::uint32_t indices_of(const Wanted& wanted, const Ends& ends, RowErrors* carried) const;
    /// v / largest of its channel
    float entry_of(float code) const;

    float step_;  ///< ln(v) from one code to the next
    float offset_;
    std::array<float, 3> scale_;  ///< largest of each channel, relative to the largest of all
    /// Entry by code in sixths, in which all mixtures of two codes are whole.
    std::array<float, 255 * 6 + 1> entry_;
};

}  // namespace lumel
