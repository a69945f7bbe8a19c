// BC4: two values of 8 bits and, by their order, six between them, or four and 0 and 255; each
// texel is one of the eight.

#include <algorithm>
#include <cmath>

#include "bench/papers/matrix_blocks.h"

namespace lumel::bench {
namespace {

constexpr int kGrayRefinements = 3;
constexpr float kFullGray = 255.0f;
constexpr int kIndices = 8;

using Palette = std::array<float, kIndices>;

/// What the indices mean for endpoints `first` and `second`, 0…255.
Palette palette_of(int first, int second)
{
    const float a = float(first), b = float(second);
    Palette values = {a, b};
    const int between = first > second ? 6 : 4;
    for (int k = 1; k <= between; ++k)
        values[std::size_t(k) + 1] =
            (float(between + 1 - k) * a + float(k) * b) / float(between + 1);
    if (between == 4) {
        values[6] = 0.0f;
        values[7] = kFullGray;
    }
    return values;
}

struct GrayChoice {
    int first = 0, second = 0;
    std::array<int, kBlockTexels> index{};
    float error = 0.0f;
};

GrayChoice choose(const GrayBlock& texels, int first, int second)
{
    GrayChoice choice{first, second};
    const Palette palette = palette_of(first, second);
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        float best = INFINITY;
        for (int index = 0; index < kIndices; ++index) {
            const float off = palette[std::size_t(index)] - texels[i];
            if (off * off < best) {
                best = off * off;
                choice.index[i] = index;
            }
        }
        choice.error += best;
    }
    return choice;
}

int quantise(float value)
{
    return int(std::lround(std::clamp(value, 0.0f, kFullGray)));
}

/// Endpoints that fit the chosen indices best, by least squares; texels at 0 or 255 apart.
GrayChoice refine(const GrayBlock& texels, const GrayChoice& choice)
{
    const bool six = choice.first > choice.second;
    float aa = 0.0f, ab = 0.0f, bb = 0.0f, ax = 0.0f, bx = 0.0f;
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        const int index = choice.index[i];
        if (!six && index >= 6)
            continue;
        const float b =
            index == 0 ? 0.0f : (index == 1 ? 1.0f : float(index - 1) / (six ? 7.0f : 5.0f));
        const float a = 1.0f - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ax += a * texels[i];
        bx += b * texels[i];
    }
    const float determinant = aa * bb - ab * ab;
    if (determinant < 1e-6f)
        return choice;
    int first = quantise((bb * ax - ab * bx) / determinant);
    int second = quantise((aa * bx - ab * ax) / determinant);
    if ((first > second) != six)
        std::swap(first, second);
    const GrayChoice next = choose(texels, first, second);
    return next.error < choice.error ? next : choice;
}

GrayChoice best_from(const GrayBlock& texels, int first, int second)
{
    GrayChoice best = choose(texels, first, second);
    for (int step = 0; step < kGrayRefinements; ++step)
        best = refine(texels, best);
    return best;
}

}  // namespace

BlockWords encode_bc4(const GrayBlock& texels)
{
    float low = kFullGray, high = 0.0f, low_inside = kFullGray;
    for (const float value : texels) {
        low = std::min(low, value);
        high = std::max(high, value);
        if (value > 0.0f)
            low_inside = std::min(low_inside, value);
    }
    GrayChoice best = best_from(texels, quantise(high), quantise(low));
    if (low <= 0.0f && high > 0.0f) {  // 0 for itself, the rest in finer steps
        const GrayChoice apart = best_from(texels, quantise(low_inside), quantise(high));
        if (apart.error < best.error)
            best = apart;
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        bits |= std::uint64_t(best.index[i]) << (3 * i);
    bits = bits << 16 | std::uint64_t(best.second) << 8 | std::uint64_t(best.first);
    return {std::uint32_t(bits), std::uint32_t(bits >> 32)};
}

GrayBlock decode_bc4(const BlockWords& words)
{
    const Palette palette = palette_of(int(words[0] & 255u), int(words[0] >> 8 & 255u));
    const std::uint64_t bits = (std::uint64_t(words[1]) << 32 | words[0]) >> 16;
    GrayBlock texels;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        texels[i] = palette[bits >> (3 * i) & 7u];
    return texels;
}

}  // namespace lumel::bench
