#ifndef LUMEL_SHOOTING_ITERATION_GLSL
#define LUMEL_SHOOTING_ITERATION_GLSL

// Running averages and the energy balance, shared by the kernels that read them. Declares `totals`.

#include "base/core/division.shared.h"
#include "solve/shooting/iteration.balance.glsl"
#include "solve/shooting/iteration.shared.h"

layout(scalar) readonly buffer Totals { Terms totals[]; };

// True if half-solution h has shots of indirect light.
bool has_indirect(Averages averages, uint h)
{
    return averages.source_shots[h] + averages.earlier_weight[h] > 0.0;
}

// Weight of the first half-solution: with balancing the halves count alike, in the papers' plain
// mean ([BJ04] Eq. (2)) all shots do.
float share_of_first(Averages averages)
{
    const float n = averages.source_shots[0] + averages.source_shots[1];
    return averages.balance == 0u && n > 0.0 ? averages.source_shots[0] / n : 0.5;
}

// Ratio of the true indirect light to that of the shots, for half-solution h. Write the reflected
// light as a pattern X / P of unit power times its power S. Its far light for unit source power is
// U, averaged over all phases, and N / P is its near light. Then S must balance:
//
//                                                        Σ A ρ D
//     S = Σ A ρ (D + S (U + N / P))      ⟹      S = ───────────────────────,      s = S / P,
//                                                     1 - Σ A ρ (U + N / P)
//
// with one unknown per colour channel. This sets the overall level of the light to the converged
// one, which averaging alone approaches slowly at high albedo.
vec3 level(Averages averages, uint h)
{
    const float kMin = 0.05, kMax = 200.0;  // beyond these the sums are noise
    const float kMinLeft = 1e-3;             // fraction of the power absorbed or lost per bounce
    if (averages.balance == 0u)
        return vec3(1.0);
    const float n = averages.source_shots[h], w = averages.earlier_weight[h];
    vec3 s = vec3(1.0);
    for (int c = 0; c < 3; ++c) {
        const float power = totals[0].column[kSourceColumn][c];
        if (power < kMinDivisor || !has_indirect(averages, h))
            continue;
        const float returned = (n * totals[0].column[kPhaseColumn + h][c] / power +
                                w * totals[0].column[kEarlierColumn + h][c]) / (n + w) +
                               totals[0].column[kNearColumn][c] / power;
        if (1.0 - returned > kMinLeft)
            s[c] = clamp(totals[0].column[kDirectColumn + h][c] / ((1.0 - returned) * power),
                         kMin, kMax);
    }
    return s;
}

// U: far light of half-solution h for unit source power, over this phase and earlier ones. Without
// balancing, the papers' plain mean.
vec3 far_pattern(Averages averages, uint h, vec3 phase_sum, vec3 earlier)
{
    const float n = averages.source_shots[h], w = averages.earlier_weight[h];
    if (!has_indirect(averages, h))
        return vec3(0.0);
    if (averages.balance == 0u)
        return phase_sum / n;
    const vec3 power = totals[0].column[kSourceColumn].rgb;
    vec3 pattern = w * earlier;
    for (int c = 0; c < 3; ++c)
        pattern[c] += power[c] >= kMinDivisor ? phase_sum[c] / power[c] : 0.0;
    return pattern / (n + w);
}

// Far indirect light of half-solution h.
vec3 far_indirect(Averages averages, uint h, vec3 phase_sum, vec3 earlier)
{
    const vec3 pattern = far_pattern(averages, h, phase_sum, earlier);
    return averages.balance == 0u
               ? pattern
               : level(averages, h) * totals[0].column[kSourceColumn].rgb * pattern;
}

#endif
