#version 460
#include "solve/transport/form_factors.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "solve/transport/block_point.glsl"
#include "solve/shooting/shooter.glsl"
#include "raster/world/channel.glsl"

// Eyes of a batch of blocks, and their shots at a radiosity of 1.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { BlockParams p; };
layout(scalar) readonly buffer Blocks { Patch blocks[]; };
layout(scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(scalar) writeonly buffer Shots { PatchShot shots[]; };

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.count)
        return;
    const Patch block = blocks[p.first + k];
    float area = 0.0, size = 0.0;
    for (uint j = block.first; j < block.first + block.count; ++j) {
        area += lumels[j].area;
        size = max(size, lumels[j].size);
    }
    shots[k] = PatchShot(vec3(area / kPi), block.size, size, block.first, block.count, 1u,
                         block.first, 1.0);
    const LumelPoint y = block_point(block);
    eyes[k] = make_eye(y.position, y.normal, hash(block.first), kAllChannels);
}
