#version 460
#include "preview/preview.shared.h"

layout(push_constant, scalar) uniform Params { PreviewParams p; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 look_in;      // base colour u, v; emissive u, v
layout(location = 2) in vec2 lightmap_in;  // 0…1
layout(location = 3) in vec4 color_in;
layout(location = 0) out vec4 look;
layout(location = 1) out vec2 lightmap;
layout(location = 2) out vec4 color;

void main()
{
    gl_Position = p.camera * vec4(position, 1.0);
    look = look_in;
    lightmap = lightmap_in;
    color = color_in;
}
