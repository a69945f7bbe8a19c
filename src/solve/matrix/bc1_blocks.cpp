// Two colours of 5, 6 and 5 bits, the ends, and one or two mixtures of them; each texel is one of
// the four. The search for ends starts at two pairs. From each, the channels of an end go up and
// down by a step, one or all of them, as long as the entries come nearer.

#include "solve/matrix/bc1_blocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/matrix/log_code.shared.h"

namespace lumel {
namespace {

constexpr int kSixths = 6;        // mixtures are thirds and halves of two codes
constexpr int kMaxSearches = 16;  // each tries every step of both ends
constexpr std::array<int, 3> kBits = {5, 6, 5};

using Coded = std::array<int, 3>;

/// Of one channel, and of all by about the same: a step of 5 bits is two of 6.
constexpr std::array<Coded, 4> kSteps = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 1}}};

/// 0…255. The hardware repeats the upper bits below the last one.
constexpr int expand(int code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

Coded quantised(const std::array<float, 3>& codes)
{
    Coded result;
    for (std::size_t c = 0; c < 3; ++c) {
        const int most = (1 << kBits[c]) - 1;
        result[c] = std::clamp(int(std::lround(codes[c] * float(most) / kLogCodes)), 0, most);
    }
    return result;
}

constexpr bool fits(const Coded& code)
{
    bool all = true;
    for (std::size_t c = 0; c < 3; ++c)
        all = all && code[c] >= 0 && code[c] < 1 << kBits[c];
    return all;
}

constexpr std::uint32_t pack(const Coded& code)
{
    return std::uint32_t(code[0] << 11 | code[1] << 5 | code[2]);
}

constexpr Coded unpack(std::uint32_t code)
{
    return {int(code >> 11 & 31u), int(code >> 5 & 63u), int(code & 31u)};
}

/// Codes by index, in sixths: the ends and two between them, or one and black.
constexpr std::array<int, 4> palette_of(int a, int b, bool black)
{
    return {6 * a, 6 * b, black ? 3 * a + 3 * b : 4 * a + 2 * b, black ? 0 : 2 * a + 4 * b};
}

bool is_zero(const std::array<float, 3>& code)
{
    return code[0] < kMinLogCode && code[1] < kMinLogCode && code[2] < kMinLogCode;
}

}  // namespace

struct Bc1Encoder::Ends {
    std::array<Coded, 2> color{};
    bool black = false;  ///< three colours and 0, instead of four
    float error = 0.0f;

    /// Two pairs to start from: the corners of the bounding box, and the brightest texel with the
    /// mean. black: without texels that are 0.
    static std::array<Ends, 2> starts(const ColorBlock& codes, bool black)
    {
        std::array<float, 3> low{}, high{}, mean{}, brightest{};
        low.fill(kLogCodes);
        float count = 0.0f;
        for (const std::array<float, 3>& code : codes) {
            if (black && is_zero(code))
                continue;
            for (std::size_t c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], code[c]);
                high[c] = std::max(high[c], code[c]);
                mean[c] = (mean[c] * count + code[c]) / (count + 1.0f);
            }
            if (code[0] + code[1] + code[2] > brightest[0] + brightest[1] + brightest[2])
                brightest = code;
            count += 1.0f;
        }
        low = count > 0.0f ? low : high;
        return {Ends{{quantised(high), quantised(low)}, black},
                Ends{{quantised(brightest), quantised(mean)}, black}};
    }
};

ColorBlock decode_bc1(const BlockWords& words)
{
    const std::uint32_t first = words[0] & 0xffffu, second = words[0] >> 16;
    ColorBlock texels;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::array<int, 4> palette =
            palette_of(expand(unpack(first)[c], kBits[c]), expand(unpack(second)[c], kBits[c]),
                       first <= second);
        for (std::size_t i = 0; i < kBlockTexels; ++i)
            texels[i][c] = float(palette[words[1] >> (2 * i) & 3u]) / kSixths;
    }
    return texels;
}

Bc1Encoder::Bc1Encoder(float offset, const std::array<float, 3>& largest)
    : step_(offset / kLogCodes),
      offset_(offset),
      scale_(largest)
{
    const float most = *std::max_element(scale_.begin(), scale_.end());
    for (float& scale : scale_)
        scale = most > 0.0f ? scale / most : 0.0f;
    for (std::size_t i = 0; i < entry_.size(); ++i)
        entry_[i] = entry_of(float(i) / kSixths);
}

float Bc1Encoder::entry_of(float code) const
{
    return code < kMinLogCode ? 0.0f : std::exp(code * step_ - offset_);
}

/// Squared error, or any number from `limit` on if it is not below. indices [kBlockTexels] of the
/// nearest colours, unless null.
float Bc1Encoder::error_of(const ColorBlock& entries, const Ends& ends, float limit,
                           std::uint32_t* indices) const
{
    std::array<std::array<float, 3>, 4> palette{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::array<int, 4> codes = palette_of(expand(ends.color[0][c], kBits[c]),
                                                    expand(ends.color[1][c], kBits[c]), ends.black);
        for (std::size_t index = 0; index < palette.size(); ++index)
            palette[index][c] = scale_[c] * entry_[std::size_t(codes[index])];
    }
    float sum = 0.0f;
    for (std::size_t i = 0; i < kBlockTexels && sum < limit; ++i) {
        float least = INFINITY;
        for (std::uint32_t index = 0; index < palette.size(); ++index) {
            float off = 0.0f;
            for (std::size_t c = 0; c < 3; ++c)
                off += (palette[index][c] - entries[i][c]) * (palette[index][c] - entries[i][c]);
            if (off < least) {
                least = off;
                if (indices)
                    indices[i] = index;
            }
        }
        sum += least;
    }
    return sum;
}

Bc1Encoder::Ends Bc1Encoder::refined(const ColorBlock& entries, Ends ends) const
{
    const auto moved = [](Ends from, std::size_t end, const Coded& step, int sign) {
        for (std::size_t c = 0; c < 3; ++c)
            from.color[end][c] += sign * step[c];
        return from;
    };
    ends.error = error_of(entries, ends, INFINITY, nullptr);
    bool nearer = true;
    for (int round = 0; nearer && round < kMaxSearches; ++round) {
        nearer = false;
        for (std::size_t end = 0; end < 2; ++end)
            for (const Coded& step : kSteps)
                for (const int sign : {-1, 1}) {
                    Ends next = moved(ends, end, step, sign);
                    if (!fits(next.color[end]))
                        continue;
                    next.error = error_of(entries, next, ends.error, nullptr);
                    if (next.error < ends.error) {
                        ends = next;
                        nearer = true;
                    }
                }
    }
    return ends;
}

// Four colours need ends that differ, the larger number first; three need the smaller first.
BlockWords Bc1Encoder::encode(const ColorBlock& codes) const
{
    ColorBlock entries;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            entries[i][c] = scale_[c] * entry_of(codes[i][c]);
    Ends best{.error = INFINITY};
    for (const bool black : {true, false})
        for (const Ends& start : Ends::starts(codes, black)) {
            const Ends ends = refined(entries, start);
            if (ends.error < best.error && (black || ends.color[0] != ends.color[1]))
                best = ends;
        }
    if ((pack(best.color[0]) > pack(best.color[1])) == best.black)
        std::swap(best.color[0], best.color[1]);
    std::array<std::uint32_t, kBlockTexels> indices{};
    error_of(entries, best, INFINITY, indices.data());
    BlockWords words = {pack(best.color[0]) | pack(best.color[1]) << 16, 0u};
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        words[1] |= indices[i] << (2 * i);
    return words;
}

}  // namespace lumel
