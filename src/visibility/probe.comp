#version 460
#include "visibility/probe.shared.h"

// Which of a list of points one eye sees.

layout(local_size_x = kProbeGroup) in;
layout(push_constant, scalar) uniform Params { ProbeParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(binding = 1, scalar) readonly buffer Questions { Question questions[]; };
layout(binding = 2) uniform sampler2D views;
layout(binding = 3, scalar) writeonly buffer Answers { uint answers[]; };

#include "visibility/sees.glsl"

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
