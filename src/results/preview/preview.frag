#version 460
#include "results/preview/preview.glsl"

// All materials: of what is cut out, and of a back that is a face of its own, not all is there.

uniform sampler2D base_color;
uniform sampler2D emissive;

void main()
{
    const vec4 base = texture(base_color, look.xy) * p.base_color * color;
    if (base.a < p.cutoff || (p.back == kBackIsAnother && !gl_FrontFacing))
        discard;
    show(base, texture(emissive, look.zw).rgb);
}
