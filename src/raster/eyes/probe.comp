#version 460
#include "raster/eyes/probe.shared.h"
#include "raster/eyes/sees.glsl"

// Visibility of a list of points from one eye.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { ProbeParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Questions { Question questions[]; };
layout(scalar) writeonly buffer Answers { uint answers[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    const Eye eye = eyes[p.eye];
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    const vec3 d = questions[i].position - eye.position;
    answers[i] = sees(p.views, p.eye, d * frame, questions[i].facing * frame) ? 1u : 0u;
}
