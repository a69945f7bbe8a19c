#version 460
#include "solve/transport/patch_shots.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "solve/transport/patches.glsl"
#include "solve/transport/block_point.glsl"
#include "solve/shooting/shooter.glsl"
#include "solve/transport/foreseen.glsl"
#include "raster/world/channel.glsl"

// Light of the chosen patches, [Hoef13] 4.3.2, GenerateShootingPatches: an eye and the power of
// each, and the radiosity that each of its lumels sends.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { TakeLightParams p; };
layout(scalar) readonly buffer Charts { PatchChart charts[]; };
layout(scalar) readonly buffer Patches { Patch patches[]; };
layout(scalar) readonly buffer Chosen { ChosenPatch chosen[]; };
layout(scalar) buffer Sending { vec3 sending[]; };
layout(scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(scalar) buffer Shots { PatchShot shots[]; };

Patch patch_of(ChosenPatch c)
{
    const PatchChart chart = charts[c.chart];
    if (c.level < kBlockLevels)
        return patches[chart.first_patch[c.level] + c.index];
    const uint lumel = chart.first_lumel + c.index / points_per_lumel(c.level);
    return Patch(lumel, 1u, lumel, lumels[lumel].size);
}

// Viewpoint of the patch: always the same, so that light can be taken back exactly.
LumelPoint eye_point(ChosenPatch c, Patch block)
{
    const uint points = points_per_lumel(c.level);
    if (points == 1u)
        return block_point(block);
    const uint part = c.index % points;
    return point_on(lumels[block.eye], (float(part) + 0.5) / float(points),
                    fract((float(part) + 0.5) * 0.6180339887));
}

vec3 sent_by(uint j, uint send)
{
    if (send == kSendTotal)
        return unshot_of(j) + shot[j];
    return send == kSendUnshot ? foreseen(j) : send == kSendBack ? -shot[j] : shot[j];
}

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.batch)
        return;
    const ChosenPatch c = chosen[k];
    if (c.chart == kNoPatch) {
        shots[k] = PatchShot(vec3(0.0), 0.0, 0.0, 0u, 0u, 1u, 0u, 1.0);
        eyes[k] = make_eye(lumels[0].position, lumels[0].normal, 0u, kAllChannels);
        return;
    }
    const Patch block = patch_of(c);
    const uint points = points_per_lumel(c.level);
    vec3 power = vec3(0.0);
    float size = 0.0;
    for (uint j = block.first; j < block.first + block.count; ++j) {
        const vec3 b = sent_by(j, c.send);
        sending[j] = b / float(points);
        power += b / float(points) * surface[j].a;
        size = max(size, lumels[j].size);
    }
    const bool any = power != vec3(0.0) || c.send >= kSendCrossing;
    shots[k] = PatchShot(power / kPi, block.size, size, block.first, any ? block.count : 0u, points,
                         p.first_number + block.first * points + c.index % points,
                         c.send == kSendBackSide ? -1.0 : 1.0);
    const LumelPoint y = eye_point(c, block);
    eyes[k] = make_eye(y.position, shots[k].facing * y.normal, hash(block.first ^ hash(c.index)),
                       kAllChannels);
}
