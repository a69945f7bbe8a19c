#version 460
#include "methods/gather/gather.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "solve/shooting/shooter.glsl"

// Places the hemicubes of a batch: each at a point of its lumel, rotated about the normal by its
// own angle [Hoef13] 4.2, and lifted slightly, so that its own surface stays out of view.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { GatherEyesParams p; };
layout(scalar) readonly buffer Order { uint order[]; };
layout(scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(scalar) writeonly buffer Points { GatheringPoint points[]; };

// Points keep this part of their distance to the piece's centre away from its edges, where other
// surfaces can be closer than the lift of eyes.
const float kInset = 0.05;
// Normals with a larger 1 - cosine count as different.
const float kTilt = 1e-6;

vec3 middle_of(Piece piece)
{
    const float along = piece.parallelogram != 0u ? 0.5 : 1.0 / 3.0;
    return piece.origin + along * (piece.edge_u + piece.edge_v);
}

// Receiving point and its normal.
LumelPoint gathering_point(uint i)
{
    const Lumel lumel = lumels[i];
    // In opposite pairs: linear functions over the lumel are integrated exactly.
    const bool paired =
        lumel.piece_count == 1u && pieces[lumel.first_piece].parallelogram != 0u;
    const uint index = paired ? p.point / 2u : p.point;
    vec2 at = low_discrepancy_point(index, hash(i ^ hash(p.seed))).xy;
    if (paired && p.point % 2u == 1u)
        at = 1.0 - at;
    LumelPoint x = point_on(lumel, at.x, at.y);
    x.facing = normalize(x.facing);
    // A lumel's centre can lie in a fold, where only the mean normal leads away from all of it.
    if (p.centre != 0u) {
        x.normal = lumel.normal;
        x.position = lumel.position + p.ray_offset * lumel.normal;
    } else
        x.position = mix(x.position, middle_of(pieces[x.piece]), kInset) + p.ray_offset * x.facing;
    return x;
}

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.eyes)
        return;
    const uint i = order[p.first + k / p.channels];
    const LumelPoint x = gathering_point(i);
    const uint random = hash(i ^ hash(p.seed ^ hash(p.point)));
    const uint channel = p.channels > 1u ? 1u + k % p.channels : kAllChannels;
    const Eye eye = make_eye(x.position, x.normal, random, channel);
    eyes[k] = eye;
    points[k] = GatheringPoint(x.facing * mat3(eye.tangent, eye.bitangent, eye.normal),
                               dot(x.facing, x.normal) < 1.0 - kTilt ? 1u : 0u);
}
