#ifndef LUMEL_SHOOTING_ITERATION_BALANCE_GLSL
#define LUMEL_SHOOTING_ITERATION_BALANCE_GLSL

// Terms of the energy balance.

vec3 mean(vec3 sum, float shots)
{
    return shots > 0.0 ? sum / shots : vec3(0.0);
}

// Columns of the sums, h = 0, 1:
const uint kDirectColumn = 0u;   // [2] Σ A ρ D
const uint kPhaseColumn = 2u;    // [2] Σ A ρ T X, mean of this phase's shots
const uint kSourceColumn = 4u;   // Σ A X
const uint kEarlierColumn = 5u;  // [2] Σ A ρ U
const uint kNearColumn = 7u;     // Σ A ρ N, near light of X

#endif
