#ifndef LUMEL_SHOOTING_POWER_PYRAMID_GLSL
#define LUMEL_SHOOTING_POWER_PYRAMID_GLSL

// Draws a lumel with probability proportional to its power: [BSS05] section 4.1, with 32 children
// per node instead of 4. Lumels are in Morton order within charts, so a stratified u spreads
// shooters over the surfaces.

#include "base/core/division.shared.h"
#include "solve/shooting/power_pyramid.shared.h"

struct Drawn {
    uint lumel;
    float probability;  // p_j; 0: there is no power
};

// weight / total, 0 if it or the total is too small to be divided by.
float share_of(float weight, float total)
{
    return min(weight, total) >= kMinDivisor ? weight / total : 0.0;
}

// drawn ← the lumel at u, 0…1, in the cumulative `weights` of a PyramidLayout.
#define DRAW_FROM(weights, pyramid, u, drawn)                                                      \
    {                                                                                              \
        const uint top = pyramid.levels - 1u;                                                      \
        const float total = weights[pyramid.first[top]];                                           \
        float rest = (u) * total;                                                                  \
        uint node = 0u;                                                                            \
        for (uint level = top; level-- > 0u;) {                                                    \
            uint child = node * kPyramidFanout;                                                    \
            const uint last = min(child + kPyramidFanout, pyramid.count[level]) - 1u;              \
            float weight = weights[pyramid.first[level] + child];                                  \
            while (child < last && rest >= weight) {                                               \
                rest -= weight;                                                                    \
                weight = weights[pyramid.first[level] + ++child];                                  \
            }                                                                                      \
            node = child;                                                                          \
        }                                                                                          \
        drawn = Drawn(node, share_of(weights[pyramid.first[0] + node], total));                    \
    }

#endif
