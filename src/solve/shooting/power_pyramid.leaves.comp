#version 460
#include "solve/shooting/power_pyramid.shared.h"
#include "solve/shooting/radiosity.glsl"

// Leaves of the pyramid: the luminance of each lumel's power,
//
//     w_j = (1 - a) 𝓛(X_j) A_j / Φ  +  a A_j / ΣA,
//
// where X is the radiosity to shoot and Φ = Σ 𝓛(X) A is the root of the last pyramid. The second,
// defensive term, of fraction a, keeps p_j > 0 where the first is far too small for the light that
// the lumel sends to its neighbours (a dark room beside a bright one).

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { PyramidLeafParams p; };
layout(scalar) readonly buffer Source { vec3 source[]; };  // X
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Power { float power[]; };  // Φ
layout(scalar) writeonly buffer Pyramid { float pyramid[]; };

void main()
{
    const uint j = gl_GlobalInvocationID.x;
    if (j >= p.count)
        return;
    const float area = surface[j].w;
    float weight = luminance(source[j]) * area;
    if (p.by_area > 0.0) {
        const bool reflects = max(surface[j].r, max(surface[j].g, surface[j].b)) > 0.0;
        weight = (1.0 - p.by_area) * weight / max(power[0], 1e-30) +
                 (reflects ? p.by_area * area / p.area_sum : 0.0);
    }
    pyramid[j] = weight;
}
