// BC1 made for the codes themselves, as encoders of pictures do: two colours of 5, 6 and 5 bits and
// two between them; each texel is one of the four.

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/glm.hpp>

#include "bench/papers/matrix_blocks.h"

namespace lumel::bench {

namespace {

constexpr int kRefinements = 3;       // more change little
constexpr int kAxisIterations = 8;    // of the power method; blocks are nearly lines
constexpr float kFullTexel = 255.0f;  // a channel's largest

constexpr std::array<int, 3> kBits = {5, 6, 5};

using Coded = std::array<int, 3>;

/// 0…255. The hardware repeats the upper bits below the last one.
constexpr int expand(int code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

glm::vec3 expand(const Coded& code)
{
    return {expand(code[0], kBits[0]), expand(code[1], kBits[1]), expand(code[2], kBits[2])};
}

constexpr std::uint32_t pack(const Coded& code)
{
    return std::uint32_t(code[0] << 11 | code[1] << 5 | code[2]);
}

/// Share of the first colour in what an index names.
constexpr std::array<float, 4> kFirstShare = {1.0f, 0.0f, 2.0f / 3.0f, 1.0f / 3.0f};

Coded quantise(const glm::vec3& color)
{
    Coded code;
    for (int c = 0; c < 3; ++c) {
        const int most = (1 << kBits[c]) - 1;
        code[c] = std::clamp(int(std::lround(color[c] * float(most) / kFullTexel)), 0, most);
    }
    return code;
}

glm::vec3 texel(const ColorBlock& texels, std::size_t i)
{
    return {texels[i][0], texels[i][1], texels[i][2]};
}

struct Choice {
    Coded first{}, second{};
    std::array<int, kBlockTexels> index{};
    float error = 0.0f;
};

/// The best index for each texel, between these two colours.
Choice choose(const ColorBlock& texels, const Coded& first, const Coded& second)
{
    Choice choice{first, second};
    const glm::vec3 a = expand(first), b = expand(second);
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        float best = INFINITY;
        // Equal colours turn index 2 and 3 into another meaning; 0 and 1 are all there is then.
        const int indices = first == second ? 1 : 4;
        for (int index = 0; index < indices; ++index) {
            const glm::vec3 off =
                glm::mix(b, a, kFirstShare[std::size_t(index)]) - texel(texels, i);
            if (glm::dot(off, off) < best) {
                best = glm::dot(off, off);
                choice.index[i] = index;
            }
        }
        choice.error += best;
    }
    return choice;
}

/// Ends of the texels' spread along the axis on which they spread most.
std::pair<glm::vec3, glm::vec3> ends_of_axis(const ColorBlock& texels)
{
    glm::vec3 mean(0.0f), low(kFullTexel), high(0.0f);
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        mean += texel(texels, i) / float(kBlockTexels);
        low = glm::min(low, texel(texels, i));
        high = glm::max(high, texel(texels, i));
    }
    glm::mat3 covariance(0.0f);
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        covariance += glm::outerProduct(texel(texels, i) - mean, texel(texels, i) - mean);
    glm::vec3 axis = high - low + glm::vec3(1e-3f);
    for (int step = 0; step < kAxisIterations; ++step) {
        const glm::vec3 next = covariance * axis;
        const float length = glm::length(next);
        axis = length > 0.0f ? next / length : axis;
    }
    axis /= std::max(glm::length(axis), 1e-6f);
    float least = 0.0f, most = 0.0f;
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        const float along = glm::dot(texel(texels, i) - mean, axis);
        least = std::min(least, along);
        most = std::max(most, along);
    }
    return {mean + most * axis, mean + least * axis};
}

/// The colours that would fit the chosen indices best, by least squares.
std::pair<glm::vec3, glm::vec3> fit(const ColorBlock& texels, const Choice& choice)
{
    float aa = 0.0f, ab = 0.0f, bb = 0.0f;
    glm::vec3 ax(0.0f), bx(0.0f);
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        const float a = kFirstShare[std::size_t(choice.index[i])], b = 1.0f - a;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ax += a * texel(texels, i);
        bx += b * texel(texels, i);
    }
    const float determinant = aa * bb - ab * ab;
    if (determinant < 1e-6f)  // all texels have one index
        return {expand(choice.first), expand(choice.second)};
    return {(bb * ax - ab * bx) / determinant, (aa * bx - ab * ax) / determinant};
}

/// For a block of one colour: codes whose mixture 2/3 : 1/3 comes closest, a channel at a time.
std::pair<Coded, Coded> single_color(const glm::vec3& color)
{
    std::pair<Coded, Coded> best{};
    for (int c = 0; c < 3; ++c) {
        const int most = (1 << kBits[c]) - 1;
        const int near = std::clamp(int(color[c] * float(most) / kFullTexel), 0, most);
        float least = INFINITY;
        for (int a = std::max(near - 3, 0); a <= std::min(near + 3, most); ++a)
            for (int b = std::max(near - 3, 0); b <= std::min(near + 3, most); ++b) {
                const float mixed = float(2 * expand(a, kBits[c]) + expand(b, kBits[c])) / 3.0f;
                if (std::abs(mixed - color[c]) < least) {
                    least = std::abs(mixed - color[c]);
                    best.first[c] = a;
                    best.second[c] = b;
                }
            }
    }
    return best;
}

/// The first colour must be the larger number: that selects the mode with two between them.
BlockWords words_of(const Choice& choice)
{
    std::uint32_t first = pack(choice.first), second = pack(choice.second), indices = 0;
    const bool swapped = first < second;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        indices |= std::uint32_t(choice.index[i] ^ (swapped ? 1 : 0)) << (2 * i);
    if (swapped)
        std::swap(first, second);
    return {first | second << 16, indices};
}

}  // namespace

BlockWords encode_bc1(const ColorBlock& texels)
{
    auto [high, low] = ends_of_axis(texels);
    Choice best = choose(texels, quantise(high), quantise(low));
    for (int step = 0; step < kRefinements; ++step) {
        const auto [a, b] = fit(texels, best);
        const Choice next = choose(texels, quantise(a), quantise(b));
        if (next.error < best.error)
            best = next;
    }
    const auto [first, second] = single_color(0.5f * (high + low));
    const Choice flat = choose(texels, first, second);
    return words_of(flat.error < best.error ? flat : best);
}

}  // namespace lumel::bench
