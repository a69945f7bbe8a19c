#ifndef LUMEL_LOBES_PHONG_GLSL
#define LUMEL_LOBES_PHONG_GLSL

// Stretched Phong model [NNS99] with its albedo; see phong.h. Declares `albedo_table`.

#include "methods/glossy/phong.lobe.glsl"
#include "methods/glossy/phong.shared.h"

layout(scalar) readonly buffer Table { float albedo_table[]; };

float albedo_row(float shininess)
{
    return clamp(log(shininess) / log(kMaxShininess), 0.0, 1.0) * float(kAlbedoExponents - 1u);
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

// a(ω) of the lobe for light from cosθ, ρ_s = 1 [BSS05] section 4.1, from the table.
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

#endif
