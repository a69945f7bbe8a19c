// Two colours of 5, 6 and 5 bits, the ends, and one or two mixtures of them; each texel is one of
// the four. The search for ends starts at two pairs. From each, the channels of an end go up and
// down by a step, one or all of them, as long as the entries come nearer.

#include "solve/matrix/bc1_blocks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solve/matrix/log_code.shared.h"

namespace lumel {
namespace {

/// Correlation ρ of the light of neighbouring columns: errors count over about 16 columns.
constexpr float kAlike = 1.0f - 1.0f / 16.0f;

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
constexpr std::array<int, 4> mixtures_of(int a, int b, bool black)
{
    return {6 * a, 6 * b, black ? 3 * a + 3 * b : 4 * a + 2 * b, black ? 0 : 2 * a + 4 * b};
}

bool is_zero(const std::array<float, 3>& code)
{
    return code[0] < kMinLogCode && code[1] < kMinLogCode && code[2] < kMinLogCode;
}

/// Squared.
float distance(const std::array<float, 3>& a, const std::array<float, 3>& b,
               const std::array<float, 3>& weight)
{
    float sum = 0.0f;
    for (std::size_t c = 0; c < 3; ++c)
        sum += weight[c] * (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

using Palette = std::array<std::array<float, 3>, 4>;

std::uint32_t nearest(const Palette& palette, const std::array<float, 3>& entry,
                      const std::array<float, 3>& weight)
{
    std::uint32_t best = 0;
    float least = distance(palette[0], entry, weight);
    for (std::uint32_t index = 1; index < palette.size(); ++index) {
        const float off = distance(palette[index], entry, weight);
        if (off < least) {
            least = off;
            best = index;
        }
    }
    return best;
}

/// r_(j − 1) becomes r_j.
std::uint32_t spread(const Palette& palette, const std::array<float, 3>& entry,
                     const std::array<float, 3>& weight, std::array<float, 3>& error)
{
    std::array<float, 3> wanted = entry;
    for (std::size_t c = 0; c < 3; ++c)
        wanted[c] += 0.5f * kAlike * error[c];
    const std::uint32_t index = nearest(palette, wanted, weight);
    for (std::size_t c = 0; c < 3; ++c)
        error[c] = kAlike * error[c] + weight[c] * (entry[c] - palette[index][c]);
    return index;
}

}  // namespace

struct Bc1Encoder::Wanted {
    ColorBlock entry{}, weight{};
    std::optional<RowErrors> carried;  ///< to the block, if errors are spread
};

struct Bc1Encoder::Ends {
    std::array<Coded, 2> color{};
    bool black = false;  ///< three colours and 0, instead of four
    float error = 0.0f;

    /// Two pairs to start from: the corners of the bounding box, and its upper one with the mean.
    /// black: without texels that are 0.
    static std::array<Ends, 2> starts(const ColorBlock& codes, const FreeChannels& free, bool black)
    {
        std::array<float, 3> low{}, high{}, mean{};
        for (std::size_t c = 0; c < 3; ++c) {
            float count = 0.0f;
            low[c] = kLogCodes;
            for (std::size_t i = 0; i < kBlockTexels; ++i) {
                if ((free[i] >> c & 1u) != 0 || (black && is_zero(codes[i])))
                    continue;
                low[c] = std::min(low[c], codes[i][c]);
                high[c] = std::max(high[c], codes[i][c]);
                mean[c] = (mean[c] * count + codes[i][c]) / (count + 1.0f);
                count += 1.0f;
            }
            low[c] = count > 0.0f ? low[c] : 0.0f;
        }
        return {Ends{{quantised(high), quantised(low)}, black},
                Ends{{quantised(high), quantised(mean)}, black}};
    }
};

ColorBlock decode_bc1(const BlockWords& words)
{
    const std::uint32_t first = words[0] & 0xffffu, second = words[0] >> 16;
    ColorBlock texels;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::array<int, 4> palette =
            mixtures_of(expand(unpack(first)[c], kBits[c]), expand(unpack(second)[c], kBits[c]),
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

std::array<std::array<float, 3>, 4> Bc1Encoder::palette_of(const Ends& ends) const
{
    std::array<std::array<float, 3>, 4> palette{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::array<int, 4> codes = mixtures_of(
            expand(ends.color[0][c], kBits[c]), expand(ends.color[1][c], kBits[c]), ends.black);
        for (std::size_t index = 0; index < palette.size(); ++index)
            palette[index][c] = scale_[c] * entry_[std::size_t(codes[index])];
    }
    return palette;
}

// If light x is alike by ρ^|j − k| in columns j and k, a row's error Σ e_j x_j is as large as
// r_j = ρ r_(j − 1) + e_j, here of e_j = v_j − p_j. Errors that are spread minimise Σ e_j² + r_j²;
// each texel takes the colour p of the least term, which is the nearest to v + ρ r_(j − 1) / 2.

/// Σ e², with Σ r² if errors are spread; or any number from `limit` on if it is not below.
float Bc1Encoder::error_of(const Wanted& wanted, const Ends& ends, float limit) const
{
    const auto palette = palette_of(ends);
    float sum = 0.0f;
    if (!wanted.carried) {
        for (std::size_t i = 0; i < kBlockTexels && sum < limit; ++i)
            sum += distance(palette[nearest(palette, wanted.entry[i], wanted.weight[i])],
                            wanted.entry[i], wanted.weight[i]);
        return sum;
    }
    RowErrors carried = *wanted.carried;
    for (std::size_t i = 0; i < kBlockTexels && sum < limit; ++i) {
        const std::uint32_t index =
            spread(palette, wanted.entry[i], wanted.weight[i], carried[i / kBlockSide]);
        sum += distance(palette[index], wanted.entry[i], wanted.weight[i]) +
               distance(carried[i / kBlockSide], {}, wanted.weight[i]);
    }
    return sum;
}

/// Indices of the nearest colours, two bits for each texel. carried: unless null, is updated to the
/// errors after the block.
std::uint32_t Bc1Encoder::indices_of(const Wanted& wanted, const Ends& ends,
                                     RowErrors* carried) const
{
    const auto palette = palette_of(ends);
    std::uint32_t indices = 0;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        indices |= (carried ? spread(palette, wanted.entry[i], wanted.weight[i],
                                     (*carried)[i / kBlockSide])
                            : nearest(palette, wanted.entry[i], wanted.weight[i]))
                   << (2 * i);
    return indices;
}

Bc1Encoder::Ends Bc1Encoder::refined(const Wanted& wanted, Ends ends) const
{
    const auto moved = [](Ends from, std::size_t end, const Coded& step, int sign) {
        for (std::size_t c = 0; c < 3; ++c)
            from.color[end][c] += sign * step[c];
        return from;
    };
    ends.error = error_of(wanted, ends, INFINITY);
    bool nearer = true;
    for (int round = 0; nearer && round < kMaxSearches; ++round) {
        nearer = false;
        for (std::size_t end = 0; end < 2; ++end)
            for (const Coded& step : kSteps)
                for (const int sign : {-1, 1}) {
                    Ends next = moved(ends, end, step, sign);
                    if (!fits(next.color[end]))
                        continue;
                    next.error = error_of(wanted, next, ends.error);
                    if (next.error < ends.error) {
                        ends = next;
                        nearer = true;
                    }
                }
    }
    return ends;
}

// Four colours need ends that differ, the larger number first; three need the smaller first.
BlockWords Bc1Encoder::encode(const ColorBlock& codes, const FreeChannels& free,
                              RowErrors* carried) const
{
    Wanted wanted;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            wanted.entry[i][c] = scale_[c] * entry_of(codes[i][c]);
            wanted.weight[i][c] = (free[i] >> c & 1u) != 0 ? 0.0f : 1.0f;
        }
    if (carried)
        wanted.carried = *carried;
    Ends best{.error = INFINITY};
    for (const bool black : {true, false})
        for (const Ends& start : Ends::starts(codes, free, black)) {
            const Ends ends = refined(wanted, start);
            if (ends.error < best.error && (black || ends.color[0] != ends.color[1]))
                best = ends;
        }
    if ((pack(best.color[0]) > pack(best.color[1])) == best.black)
        std::swap(best.color[0], best.color[1]);
    return {pack(best.color[0]) | pack(best.color[1]) << 16, indices_of(wanted, best, carried)};
}

}  // namespace lumel
