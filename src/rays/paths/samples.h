#pragma once
// Low-discrepancy points for the path tracer: the first two Sobol dimensions, shuffled and
// Owen-scrambled by a hash for every pair of dimensions that a path uses.
//
// [Bur20] B. Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020.
//
// Points of different streams and of different pairs are independent; within one pair of one
// stream, every aligned run of 2^k points is a (0, k, 2)-net.

#include <bit>
#include <cstdint>

#include <glm/glm.hpp>

namespace lumel {

/// Point `index` of each pair of dimensions of one stream.
class PathSamples {
public:
    PathSamples(std::uint32_t stream, std::uint32_t index)
        : stream_(stream),
          index_(reverse_bits(index)),
          path_(hash(stream, index))
    {
    }

    /// 32-bit hash of two numbers.
    static std::uint32_t hash(std::uint32_t a, std::uint32_t b)
    {
        std::uint32_t x = a * 0x9e3779b1u + (b ^ 0x5bd1e995u) * 0x85ebca6bu;
        x = (x ^ (x >> 16)) * 0x7feb352du;
        x = (x ^ (x >> 15)) * 0x846ca68bu;
        return x ^ (x >> 16);
    }

    /// Stratified point of dimension pair `pair`, in [0, 1)².
    glm::vec2 stratified(std::uint32_t pair) const
    {
        const std::uint32_t key = hash(stream_, pair);
        const std::uint32_t shuffled = reverse_bits(owen(index_, key));
        const std::uint32_t x = reverse_bits(owen(shuffled, key * 0x2c1b3c6du + 0x297a2d39u));
        const std::uint32_t y = reverse_bits(
            owen(reverse_bits(sobol_second(shuffled)), key * 0x1b56c4e9u + 0x7ed55d16u));
        return {to_unit(x), to_unit(y)};
    }

    /// Independent random point in [0, 1)², cheaper than a stratified one.
    glm::vec2 random(std::uint32_t pair) const
    {
        const std::uint32_t key = bits(pair);
        return {to_unit(key), to_unit(hash(key, 0x68e31da4u))};
    }

    /// 32 random bits.
    std::uint32_t bits(std::uint32_t pair) const { return hash(path_, pair); }

    static float to_unit(std::uint32_t x) { return float(x >> 8) * 0x1p-24f; }

private:
    static std::uint32_t reverse_bits(std::uint32_t x)
    {
        x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
        x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
        x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
        x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
        return std::rotl(x, 16);
    }

    /// Laine-Karras hash: an Owen scramble of a bit-reversed number. [Bur20] Listing 2
    static std::uint32_t owen(std::uint32_t x, std::uint32_t seed)
    {
        x ^= x * 0x3d20adeau;
        x += seed;
        x *= (seed >> 16) | 1u;
        x ^= x * 0x05526c56u;
        x ^= x * 0x53a22864u;
        return x;
    }

    /// The second Sobol dimension: Pascal's triangle mod 2 times the reversed index. C(k, j) is odd
    /// if j's bits are a subset of k's, so the product is a sum over supersets, bit by bit.
    static std::uint32_t sobol_second(std::uint32_t x)
    {
        x = reverse_bits(x);
        x ^= x << 16;
        x ^= (x & 0x00ff00ffu) << 8;
        x ^= (x & 0x0f0f0f0fu) << 4;
        x ^= (x & 0x33333333u) << 2;
        x ^= (x & 0x55555555u) << 1;
        return x;
    }

    std::uint32_t stream_;
    std::uint32_t index_;  ///< bit-reversed for the scrambles
    std::uint32_t path_;   ///< key of the random numbers
};

}  // namespace lumel
