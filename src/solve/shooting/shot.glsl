#ifndef LUMEL_SHOOTING_SHOT_GLSL
#define LUMEL_SHOOTING_SHOT_GLSL

// Visibility of lumels from shots. Declares the batch: `eyes` and `shots`.

#include "raster/near/near_pairs.glsl"
#include "solve/shooting/receiver.glsl"
#include "solve/shooting/shooters.shared.h"

layout(scalar) uniform Eyes { Eye eyes[kMaxBatch]; };
layout(scalar) uniform Shots { Shot shots[kMaxBatch]; };

// True if light of shot k arrives on the front and the pair is not in the near field. `d` leads
// from the shooter to the receiving point.
bool arrives(Receiver r, uint k, EyeViewLayout tiling, float near_radius, out vec3 d)
{
    d = r.x - eyes[k].position;
    return shots[k].lumel != r.lumel &&
           !is_near(r.centre, r.size, shots[k].centre, shots[k].size, near_radius) &&
           is_seen(r, eyes[k], k, tiling);
}

#endif
