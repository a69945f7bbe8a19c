// The ends come from the codes' axis of largest spread; then each of their channels goes up and
// down by a step as long as the entries come nearer.

#include "solve/matrix/bc1_logarithms.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/matrix/bc1_colors.h"
#include "solve/matrix/log_code.shared.h"

namespace lumel {

using namespace bc1;

namespace {

constexpr int kSixths = 6;     // mixtures are thirds and halves of two codes
constexpr int kMaxRounds = 8;  // each tries every channel of both ends

bool is_zero(const std::array<float, 3>& code)
{
    return code[0] < kMinLogCode && code[1] < kMinLogCode && code[2] < kMinLogCode;
}

}  // namespace

struct LogarithmsInBc1::Ends {
    std::array<Coded, 2> color{};
    bool black = false;  ///< three colours and 0, instead of four
    float error = 0.0f;
};

LogarithmsInBc1::LogarithmsInBc1(float offset, const std::array<float, 3>& largest)
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

float LogarithmsInBc1::entry_of(float code) const
{
    return code < kMinLogCode ? 0.0f : std::exp(code * step_ - offset_);
}

float LogarithmsInBc1::error_of(const ColorBlock& entries, const Ends& ends,
                                std::array<std::uint32_t, kBlockTexels>* indices) const
{
    std::array<std::array<float, 3>, 4> palette{};
    for (std::size_t c = 0; c < 3; ++c) {
        const int a = expand(ends.color[0][c], kBits[c]), b = expand(ends.color[1][c], kBits[c]);
        const auto entry = [&](int sixths) { return scale_[c] * entry_[std::size_t(sixths)]; };
        palette[0][c] = entry(6 * a);
        palette[1][c] = entry(6 * b);
        palette[2][c] = entry(ends.black ? 3 * a + 3 * b : 4 * a + 2 * b);
        palette[3][c] = ends.black ? 0.0f : entry(2 * a + 4 * b);
    }
    float sum = 0.0f;
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        float least = INFINITY;
        for (std::uint32_t index = 0; index < palette.size(); ++index) {
            float off = 0.0f;
            for (std::size_t c = 0; c < 3; ++c)
                off += (palette[index][c] - entries[i][c]) * (palette[index][c] - entries[i][c]);
            if (off < least) {
                least = off;
                if (indices)
                    (*indices)[i] = index;
            }
        }
        sum += least;
    }
    return sum;
}

LogarithmsInBc1::Ends LogarithmsInBc1::refined(const ColorBlock& entries, Ends ends) const
{
    ends.error = error_of(entries, ends);
    bool nearer = true;
    for (int round = 0; nearer && round < kMaxRounds; ++round) {
        nearer = false;
        for (std::size_t end = 0; end < 2; ++end)
            for (std::size_t c = 0; c < 3; ++c)
                for (const int step : {-1, 1}) {
                    Ends next = ends;
                    next.color[end][c] += step;
                    if (next.color[end][c] < 0 || next.color[end][c] >= 1 << kBits[c])
                        continue;
                    next.error = error_of(entries, next);
                    if (next.error < ends.error) {
                        ends = next;
                        nearer = true;
                    }
                }
    }
    return ends;
}

// Four colours need ends that differ, the larger number first; three need the smaller first.
BlockWords LogarithmsInBc1::encode(const ColorBlock& codes) const
{
    ColorBlock entries, lit = codes;
    std::size_t last_lit = kBlockTexels;
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            entries[i][c] = scale_[c] * entry_of(codes[i][c]);
        last_lit = is_zero(codes[i]) ? last_lit : i;
    }
    if (last_lit == kBlockTexels)
        return {0u, 0u};
    for (std::array<float, 3>& code : lit)
        code = is_zero(code) ? codes[last_lit] : code;
    const auto begin = [](const BlockWords& words, bool black) {
        return Ends{{unpack(words[0] & 0xffffu), unpack(words[0] >> 16)}, black};
    };
    Ends best = refined(entries, begin(encode_bc1(lit), true));
    const Ends four = refined(entries, begin(encode_bc1(codes), false));
    if (four.error < best.error && four.color[0] != four.color[1])
        best = four;
    if ((pack(best.color[0]) > pack(best.color[1])) == best.black)
        std::swap(best.color[0], best.color[1]);
    std::array<std::uint32_t, kBlockTexels> indices{};
    error_of(entries, best, &indices);
    BlockWords words = {pack(best.color[0]) | pack(best.color[1]) << 16, 0u};
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        words[1] |= indices[i] << (2 * i);
    return words;
}

}  // namespace lumel
