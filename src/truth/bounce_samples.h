#pragma once
// The random numbers of one bounce of a path.

#include <cstdint>

#include <glm/glm.hpp>

#include "rays/paths/samples.h"

namespace lumel {

/// Dimension pair of `PathSamples` that is free for where a path starts.
inline constexpr std::uint32_t kStartPair = 0;

/// What a bounce draws numbers for.
enum class Draw : std::uint32_t { emitter, direction, roulette, sky, lamp, lamp_choice, count };

class BounceSamples {
public:
    BounceSamples(const PathSamples& samples, int bounce)
        : samples_(samples),
          first_pair_(kStartPair + 1 + std::uint32_t(Draw::count) * std::uint32_t(bounce)),
          stratified_(bounce < kStratifiedBounces)
    {
    }

    /// A point in the unit square.
    glm::vec2 point(Draw draw) const
    {
        return stratified_ ? samples_.stratified(pair(draw)) : samples_.random(pair(draw));
    }

    /// A number in [0, 1) that is independent of all others.
    float number(Draw draw) const { return samples_.random(pair(draw)).x; }

    /// Seed of a ray.
    std::uint32_t bits(Draw draw) const { return samples_.bits(pair(draw)); }

private:
    /// Bounces that draw stratified points; later ones add too little for it to pay.
    static constexpr int kStratifiedBounces = 1;

    std::uint32_t pair(Draw draw) const { return first_pair_ + std::uint32_t(draw); }

    const PathSamples& samples_;
    std::uint32_t first_pair_;
    bool stratified_;
};

}  // namespace lumel
