#include "results/preview/preview.shared.h"

// Reflected plus emitted radiance of a diffuse surface:  L = ρ H / π + L_e.

layout(push_constant, scalar) uniform Params { PreviewParams p; };
uniform sampler2D irradiance;
layout(location = 0) in vec4 look;
layout(location = 1) in vec2 lightmap;
layout(location = 2) in vec4 color;
layout(location = 0) out vec4 radiance;

void show(vec4 base, vec3 emissive)
{
    const vec3 albedo = clamp(base.rgb, 0.0, 1.0);
    const vec3 arriving = textureLod(irradiance, lightmap, 0.0).rgb;
    const vec3 reflected = albedo * arriving / 3.14159265358979;
    const bool shows = gl_FrontFacing || p.back == kBackIsAlike;
    const vec3 emitted = p.emitted * emissive;
    const vec3 sent = p.shows == kShowsMap ? arriving : reflected + emitted;
    radiance = vec4(shows ? sent : vec3(0.0), 1.0);
}
