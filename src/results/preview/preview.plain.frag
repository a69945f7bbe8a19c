#version 460
#include "results/preview/preview.glsl"

// The same without textures, each of which takes as long as all else of a pixel.

void main()
{
    show(p.base_color * color, vec3(1.0));
}
