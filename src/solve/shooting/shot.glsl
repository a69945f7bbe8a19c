#ifndef LUMEL_SHOOTING_SHOT_GLSL
#define LUMEL_SHOOTING_SHOT_GLSL

// Which shots reach a lumel. Declares the batch: `eyes` and `shots`.

#include "raster/near/near_pairs.glsl"
#include "solve/shooting/receiver.glsl"
#include "solve/shooting/shooters.shared.h"

layout(scalar) uniform Eyes { Eye eyes[kMaxBatch]; };
layout(scalar) uniform Shots { Shot shots[kMaxBatch]; };

// Does the light of shot k arrive, from the front and not through the near field? `d` leads from
// the shooter to the receiving point.
bool arrives(Receiver r, uint k, EyeViewLayout tiling, float near_radius, out vec3 d)
{
    d = r.x - eyes[k].position;
    return shots[k].lumel != r.lumel &&
           !is_near(r.centre, r.size, shots[k].centre, shots[k].size, near_radius) &&
           is_seen(r, eyes[k], k, tiling);
}

#endif
