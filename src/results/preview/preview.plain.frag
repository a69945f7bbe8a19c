#version 460
#include "results/preview/preview.glsl"

// Without textures, each of which takes as long as the rest of a pixel.

void main()
{
    show(p.base_color * color, vec3(1.0));
}
