// The stretched Phong model [NNS99]; see phong.h. The includer declares `float albedo_table[]`.

#include "solve/phong.shared.h"

// f_r without ρ_s, for ρ_d = 0. Unit vectors away from the surface; `normal` on their side.
float phong_lobe(vec3 to_light, vec3 to_eye, vec3 normal, float shininess)
{
    const float cos_in = dot(normal, to_light), cos_out = dot(normal, to_eye);
    const float mirrored = dot(2.0 * cos_in * normal - to_light, to_eye);
    if (cos_in <= 0.0 || cos_out <= 0.0 || mirrored <= 0.0)
        return 0.0;
    return (shininess + 1.0) * (0.5 / kPi) * pow(mirrored, shininess) / max(cos_in, cos_out);
}

float albedo_row(float shininess)
{
    return clamp(log(shininess) / log(kMostShininess), 0.0, 1.0) * float(kAlbedoExponents - 1u);
}

float albedo_between(float row, float column)
{
    const uint stride = kAlbedoCosines + 1u;
    const uint r = min(uint(row), kAlbedoExponents - 2u), c = uint(column);
    const uint next = min(c + 1u, kAlbedoCosines - 1u);
    const float x = c < kAlbedoCosines ? column - float(c) : 0.0;
    const uint at = r * stride;
    const float low = mix(albedo_table[at + c], albedo_table[at + next], x);
    const float high = mix(albedo_table[at + stride + c], albedo_table[at + stride + next], x);
    return mix(low, high, row - float(r));
}

// a(ω) of the lobe for light from cosθ, ρ_s = 1 [BSS05] section 4.1, tabulated.
float phong_albedo(float cos_in, float shininess)
{
    return albedo_between(albedo_row(shininess),
                          clamp(cos_in, 0.0, 1.0) * float(kAlbedoCosines - 1u));
}

// Its mean over diffuse incoming light.
float phong_mean_albedo(float shininess)
{
    return albedo_between(albedo_row(shininess), float(kAlbedoCosines));
}
