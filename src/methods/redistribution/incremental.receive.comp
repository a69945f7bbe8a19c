#version 460
#include "methods/redistribution/incremental.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "solve/transport/patch_light.glsl"
#include "methods/progressive/visibility_rows.glsl"

// Redistributes the shot light of a batch of patches, [Hoef13] 4.4, Eq. (3.2.1):
//
//     H_i += Σ_k B_k^s A_k · (V' - V) · cosθ_i cosθ_k / (π r²)
//
// Processes only pairs that moved, R(C,M), R(M,C), R(M,M), or whose line of sight crosses a moved
// object, R(C,C); elsewhere V' is V. For patches with rows V is stored, and light is computed only
// where V' differs: the four cases of section 4.4.1. Patches without rows send with - and the old
// views, then with + and the new ones. The light of pairs that moved is taken away before: all is
// sent to them again.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { RedistributeParams p; };
layout(scalar) buffer Far { vec3 far[]; };
layout(scalar) readonly buffer Moved { uint moved[]; };  // [instances]
layout(scalar) readonly buffer Boxes { MovedBox boxes[]; };  // [p.boxes]

const uint kWordBits = 32u;
// Bounding radius of a lumel about its position, in sizes (lumel.shared.h).
const float kReach = 1.4143;

// True if the segment, of this width at its end, hits the box, enlarged by the views' pixel error.
bool meets(MovedBox box, vec3 from, vec3 direction, float width)
{
    const vec3 reach = max(abs(box.low - from), abs(box.high - from));
    const float margin = p.slack * length(reach) + width;
    const vec3 side = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(direction, vec3(0.0)));
    const vec3 inverse = side / max(abs(direction), vec3(1e-30));
    const vec3 a = (box.low - margin - from) * inverse, b = (box.high + margin - from) * inverse;
    const vec3 enter = min(a, b), leave = max(a, b);
    return max(max(enter.x, enter.y), max(enter.z, 0.0)) <=
           min(min(leave.x, leave.y), min(leave.z, 1.0));
}

// True if a line of sight from a point to any point of the lumel can hit moved objects.
bool is_affected(vec3 from, Lumel to)
{
    bool any = false;
    for (uint b = 0u; b < p.boxes; ++b)
        any = any || meets(boxes[b], from, to.position - from, kReach * to.size);
    return any;
}

bool has_moved(uint k)
{
    return moved[lumels[shots[k].first].instance] != 0u;
}

// Bits of the next kWordBits shots from `first` on that can have changed.
uint shots_that_matter(Lumel lumel, bool lumel_moved, uint first)
{
    uint found = 0u;
    for (uint k = first; k < min(first + kWordBits, p.batch.shots); ++k)
        if (shots[k].count > 0u &&
            (p.batch.sign_factor > 0.0 || row_of[p.batch.first_place + k] == kNoRow) &&
            (lumel_moved || has_moved(k) || is_affected(eyes[k].position, lumel)))
            found |= 1u << (k - first);
    return found;
}

// Change by a shot at the lumel: its light now minus its light before.
vec3 change_of(uint k, Lumel lumel, uint i, bool lumel_moved)
{
    const uint row = row_of[p.batch.first_place + k];
    if (row == kNoRow)
        return p.batch.sign_factor * light_of(k, lumel, i, p.batch.near_radius, p.batch.views);
    const Receiver r = receiver_at(receiving_point(lumel, i, shots[k].number, 0u, false), lumel, i);
    const bool was = was_seen(row, i, p.batch.count);
    const bool is = is_seen(r, eyes[k], k, p.batch.views);
    if (was != is && p.keeps != 0u)
        keep_seen(row, i, p.batch.count, is);
    const float change = float(is) - (lumel_moved || has_moved(k) ? 0.0 : float(was));
    return change != 0.0 ? change * light_without_occluders(r, k, p.batch.near_radius) : vec3(0.0);
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    const bool i_moved = moved[lumel.instance] != 0u;
    if ((lumel.flags & kLumelBuried) != 0u || (i_moved && p.batch.sign_factor < 0.0))
        return;
    // First selects shots, then adds their light: a group takes as many rounds as its lumel with
    // most shots.
    vec3 sum = vec3(0.0);
    for (uint first = 0u; first < p.batch.shots; first += kWordBits)
        for (uint left = shots_that_matter(lumel, i_moved, first); left != 0u; left &= left - 1u)
            sum += change_of(first + uint(findLSB(left)), lumel, i, i_moved);
    far[i] += sum;
}
