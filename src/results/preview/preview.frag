#version 460
#include "results/preview/preview.glsl"

// All materials: discards cut-outs, and backs that have their own face.

uniform sampler2D base_color;
uniform sampler2D emissive;

void main()
{
    const vec4 base = texture(base_color, look.xy) * p.base_color * color;
    if (base.a < p.cutoff || (p.back == kBackIsAnother && !gl_FrontFacing))
        discard;
    show(base, texture(emissive, look.zw).rgb);
}
