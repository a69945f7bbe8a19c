#pragma once
// Random numbers of a lumel's rays, stratified over neighbouring lumels too.
//
// [AW20] A. G. M. Ahmed, P. Wonka. Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error
//        via Hierarchical Ordering of Pixels. SIGGRAPH Asia 2020.

#include <bit>
#include <cstdint>

#include "atlas/packing/lumel.shared.h"
#include "rays/paths/samples.h"

namespace lumel {

/// Points of the rays that a lumel sends in one pass. Lumels of a block of the atlas are numbered
/// along a Z curve and take consecutive runs of one scrambled Sobol sequence [AW20], so that in
/// each aligned square of 2^a × 2^a lumels with as many rays, all rays form one net: the error of
/// their mean falls faster than that of independent lumels, and noise has few low frequencies.
/// Lumels whose numbers of rays round up to other powers of two have independent sequences.
class LumelSamples {
public:
    /// width: of the atlas [texels]. rays: of the lumel in this pass.
    LumelSamples(const Lumel& lumel, std::uint32_t width, std::uint32_t seed, std::uint32_t rays)
    {
        const std::uint32_t x = lumel.texel % width, y = lumel.texel / width;
        const std::uint32_t run = std::bit_ceil(rays);
        const std::uint32_t block = PathSamples::hash(x / kBlock, y / kBlock);
        const std::uint32_t side = lumel.flags & kLumelBack ? 1u : 0u;
        stream_ = PathSamples::hash(PathSamples::hash(PathSamples::hash(seed, run), block), side);
        first_ = run * (spread_bits(x % kBlock) | spread_bits(y % kBlock) << 1);
    }

    /// Point of ray k.
    PathSamples operator[](std::uint32_t k) const { return {stream_, first_ + k}; }

private:
    /// Side of a block [texels]: with 2^16 rays a lumel, its indices fill 28 bits.
    static constexpr std::uint32_t kBlock = 64;

    /// Moves bit b to bit 2 b.
    static std::uint32_t spread_bits(std::uint32_t x)
    {
        x = (x | x << 4) & 0x0f0fu;
        x = (x | x << 2) & 0x3333u;
        return (x | x << 1) & 0x5555u;
    }

    std::uint32_t stream_, first_;
};

}  // namespace lumel
