#ifndef LUMEL_SHOOTING_POWER_PYRAMID_GLSL
#define LUMEL_SHOOTING_POWER_PYRAMID_GLSL

// Drawing a lumel with probability proportional to its power: [BSS05] section 4.1, with 32
// children to a node instead of 4. The lumels lie in Morton order within charts, so a
// stratified u gives shooters that are spread over the surfaces.

#include "solve/shooting/power_pyramid.shared.h"

struct Drawn {
    uint lumel;
    float probability;  // p_j; 0: there is no power at all
};

// drawn ← the lumel where u, 0…1, falls in the sums `weights`, a PyramidLayout's.
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
        drawn = Drawn(node, total > 0.0 ? weights[pyramid.first[0] + node] / total : 0.0);         \
    }

#endif
