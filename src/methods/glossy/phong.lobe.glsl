#ifndef LUMEL_LOBES_PHONG_LOBE_GLSL
#define LUMEL_LOBES_PHONG_LOBE_GLSL

// Stretched Phong model [NNS99]; see phong.h.

#include "solve/shooting/radiosity.glsl"

// f_r without ρ_s, for ρ_d = 0. Unit vectors away from the surface; `normal` on their side.
float phong_lobe(vec3 to_light, vec3 to_eye, vec3 normal, float shininess)
{
    const float cos_in = dot(normal, to_light), cos_out = dot(normal, to_eye);
    const float mirrored = dot(2.0 * cos_in * normal - to_light, to_eye);
    if (cos_in <= 0.0 || cos_out <= 0.0 || mirrored <= 0.0)
        return 0.0;
    return (shininess + 1.0) * (0.5 / kPi) * pow(mirrored, shininess) / max(cos_in, cos_out);
}

#endif
