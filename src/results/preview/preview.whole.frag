#version 460
#include "results/preview/preview.glsl"

// Opaque surfaces: occluded fragments are not shaded.

uniform sampler2D base_color;
uniform sampler2D emissive;

void main()
{
    show(texture(base_color, look.xy) * p.base_color * color, texture(emissive, look.zw).rgb);
}
