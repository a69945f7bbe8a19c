#version 460
#include "live/incremental.shared.h"
#include "atlas/lumel.shared.h"
#include "core/hash.glsl"
#include "shooting/radiosity.glsl"

// Redistributes what the patches of a batch have shot [Hoef13] 4.4, Eq. (3.2.1):
//
//     H_i += ± Σ_k B_k^s A_k · V · cosθ_i cosθ_k / (π r²)
//
// with - and the views of before, then with + and those of after. Where nothing moved, both would
// be the same: only pairs are looked at that moved themselves, R(C,M), R(M,C), R(M,M), or whose
// line of sight meets what moved, R(C,C).

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { RedistributeParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(binding = 3, scalar) readonly buffer Shots { PatchShot shots[]; };
layout(binding = 4) uniform sampler2D views;
layout(binding = 5, scalar) readonly buffer Sending { vec3 sending[]; };
layout(binding = 6, scalar) buffer Far { vec3 far[]; };
layout(binding = 7, scalar) readonly buffer Moved { uint moved[]; };      // [instances]
layout(binding = 8, scalar) readonly buffer Boxes { MovedBox boxes[]; };  // [p.boxes]

#include "world/lumel.glsl"
#include "world/receiving_point.glsl"
#include "visibility/sees.glsl"
#include "transport/patch_light.glsl"

const uint kWordBits = 32u;
// No point of a lumel is farther from its position than this many times its size (lumel.shared.h).
const float kReach = 1.4143;

// Does the segment, so wide where it ends, meet the box, made larger by what a view's pixels may
// add to it?
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

// Can a line of sight from a point to anywhere on the lumel meet what moved?
bool is_affected(vec3 from, Lumel to)
{
    bool any = false;
    for (uint b = 0u; b < p.boxes; ++b)
        any = any || meets(boxes[b], from, to.position - from, kReach * to.size);
    return any;
}

// Of the shots from `first` on, as many as a word has bits: those that matter.
uint shots_that_matter(Lumel lumel, bool lumel_moved, uint first)
{
    uint found = 0u;
    for (uint k = first; k < min(first + kWordBits, p.shots); ++k)
        if (shots[k].count > 0u && (lumel_moved || moved[lumels[shots[k].first].instance] != 0u ||
                                    is_affected(eyes[k].position, lumel)))
            found |= 1u << (k - first);
    return found;
}

void main()
{
    const uint i = p.first + gl_GlobalInvocationID.x;
    if (i >= p.last)
        return;
    const Lumel lumel = lumels[i];
    const bool i_moved = moved[lumel.instance] != 0u;
    if ((lumel.flags & kLumelBuried) != 0u || (i_moved && p.sign_ < 0.0))
        return;
    // First which, then their light: a group takes as many rounds as one lumel of it has shots.
    vec3 sum = vec3(0.0);
    for (uint first = 0u; first < p.shots; first += kWordBits)
        for (uint left = shots_that_matter(lumel, i_moved, first); left != 0u; left &= left - 1u)
            sum += light_of(first + uint(findLSB(left)), lumel, i, p.near_radius, p.views);
    far[i] += p.sign_ * sum;
}
