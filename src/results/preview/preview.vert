#version 460
#include "results/preview/preview.shared.h"

layout(push_constant, scalar) uniform Params { PreviewParams p; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 look;      // base colour u, v; emissive u, v
layout(location = 2) in vec2 lightmap;  // 0…1
layout(location = 3) in vec4 color;
layout(location = 0) out vec4 look_out;
layout(location = 1) out vec2 lightmap_out;
layout(location = 2) out vec4 color_out;

void main()
{
    gl_Position = p.camera * vec4(position, 1.0);
    look_out = look;
    lightmap_out = lightmap;
    color_out = color;
}
