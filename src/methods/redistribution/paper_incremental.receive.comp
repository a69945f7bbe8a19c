#version 460
#include "methods/redistribution/paper_incremental.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"

// [Hoef13] Algorithm 4.3: redistribution and a progressive iteration in one pass. A static patch k
// sends, by the visibility V before and V' after the move,
//
//     to C   V    V'   IncrementalReconstructionShader
//            1    0    -B^s         occluded
//            0    1     B           unoccluded: shot and unshot light
//            1    1     B - B^s     unshot light
//            0    0     0
//     to M        V'    B           all light is shot again, Eq. (4.4.1)
//
// All are V' B - V B^s, with V = 0 for M, whose light was cleared. Patches without stored
// visibility first take V B^s back with the old views.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { MergedParams p; };
layout(scalar) buffer Far { vec3 far[]; };
layout(scalar) readonly buffer Moved { uint moved[]; };          // [instances]
layout(scalar) readonly buffer Shot { vec3 shot[]; };            // B^s [N]
layout(scalar) readonly buffer ShotBefore { PatchShot shot_before[]; };  // B^s of the batch [K]

// Share of the whole light and of the shot light that the pair transports now.
float of_whole, of_shot;

#define POWER_OF(k) (of_whole * shots[k].power - of_shot * shot_before[k].power)
#define SENDING_OF(k, j) (of_whole * sending[j] - of_shot * shot[j] / float(shots[k].parts))
#include "solve/transport/patch_light.glsl"
#include "methods/progressive/visibility_rows.glsl"

void choose_case(uint k, Receiver r, bool is_moved)
{
    const uint row = row_of[p.batch.first_place + k];
    const bool is = is_seen(r, eyes[k], k, p.batch.views);
    if (p.takes_back != 0u) {
        of_whole = 0.0;
        of_shot = row == kNoRow && is ? 1.0 : 0.0;
        return;
    }
    const bool was = row != kNoRow && was_seen(row, r.lumel, p.batch.count);
    if (row != kNoRow && was != is)
        keep_seen(row, r.lumel, p.batch.count, is);
    of_whole = float(is);
    of_shot = was && !is_moved ? 1.0 : 0.0;
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    const bool is_moved = moved[lumel.instance] != 0u;
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.batch.shots; ++k) {
        if (shots[k].count == 0u)
            continue;
        const Receiver r =
            receiver_at(receiving_point(lumel, i, shots[k].number, 0u, false), lumel, i);
        choose_case(k, r, is_moved);
        if (of_whole != 0.0 || of_shot != 0.0)
            sum += light_without_occluders(r, k, p.batch.near_radius);
    }
    far[i] += sum;
}
