#version 460
#include "visibility/hemicube.shared.h"
#include "visibility/hemicube.glsl"

// One vertex as the eye sees it through one face: 90° frustum, reversed z, far at infinity.

layout(push_constant, scalar) uniform Params { HemicubeParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;

void main()
{
    const Eye eye = eyes[p.eye];
    const Face face = hemicube_face(eye, p.face);
    const vec3 d = position - eye.position;
    const float w = dot(d, face.axis);
    const float up = dot(d, face.up);
    // A side face shows only 0 ≤ up / w ≤ 1.
    gl_Position = vec4(dot(d, face.right), p.face == 0u ? up : 2.0 * up - w, p.near, w);
}
