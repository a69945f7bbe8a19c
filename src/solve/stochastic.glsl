// Running averages and the energy balance, shared by the kernels that read them. The includer
// declares `Terms totals[]`.

vec3 mean(vec3 sum, float shots)
{
    return shots > 0.0 ? sum / shots : vec3(0.0);
}

// How much brighter the true indirect light is than the one that was shot, for half-solution h.
// All light together must balance: with X the source that was shot, T its far and near
// transport, and D the direct light,
//
//     s Σ A X  =  Σ A ρ (D + s T X)      ⟹      s = Σ A ρ D / (Σ A X - Σ A ρ T X),
//
// one unknown per colour channel. It carries the source's overall level to where the bounces
// would settle, which averaging alone reaches only slowly when albedos are high.
vec3 level(Averages averages, uint h)
{
    const float kLeast = 0.05, kMost = 200.0;  // beyond these the sums hold only noise
    if (averages.balance == 0u)
        return vec3(1.0);
    const vec3 direct = totals[0].column[h].rgb;
    const vec3 shot = totals[0].column[4].rgb;
    const vec3 left = shot - totals[0].column[2u + h].rgb;
    vec3 s;
    for (int c = 0; c < 3; ++c)
        s[c] = left[c] > 1e-6 * shot[c] ? clamp(direct[c] / left[c], kLeast, kMost) : 1.0;
    return s;
}

// Far indirect light of half-solution h: this phase's mean beside that of earlier phases.
vec3 far_indirect(Averages averages, uint h, vec3 phase_sum, vec3 earlier)
{
    const float n = averages.source_shots[h], w = averages.earlier_weight[h];
    if (n + w <= 0.0)
        return vec3(0.0);
    return (level(averages, h) * phase_sum + w * earlier) / (n + w);
}
