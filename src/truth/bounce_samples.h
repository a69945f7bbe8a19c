#pragma once
// Random numbers of one bounce of a path.

#include <cstdint>

#include <glm/glm.hpp>

#include "rays/paths/samples.h"

namespace lumel {

/// Dimension pair of `PathSamples` for the start of a path.
inline constexpr std::uint32_t kStartPair = 0;

/// Uses of random numbers in a bounce.
enum class Draw : std::uint32_t { emitter, direction, roulette, sky, lamp, lamp_choice, count };

class BounceSamples {
public:
    BounceSamples(const PathSamples& samples, int bounce)
        : samples_(samples),
          first_pair_(kStartPair + 1 + std::uint32_t(Draw::count) * std::uint32_t(bounce)),
          stratified_(bounce < kStratifiedBounces)
    {
    }

    /// Point in the unit square.
    glm::vec2 point(Draw draw) const
    {
        return stratified_ ? samples_.stratified(pair(draw)) : samples_.random(pair(draw));
    }

    /// Number in [0, 1), independent of all others.
    float number(Draw draw) const { return samples_.random(pair(draw)).x; }

    /// Seed of a ray.
    std::uint32_t bits(Draw draw) const { return samples_.bits(pair(draw)); }

private:
    /// Bounces with stratified points; later ones contribute too little.
    static constexpr int kStratifiedBounces = 1;

    std::uint32_t pair(Draw draw) const { return first_pair_ + std::uint32_t(draw); }

    const PathSamples& samples_;
    std::uint32_t first_pair_;
    bool stratified_;
};

}  // namespace lumel
