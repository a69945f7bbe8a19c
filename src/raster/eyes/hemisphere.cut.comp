#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemisphere.shared.h"
#include "raster/eyes/hemisphere.cut.glsl"

// Chooses the subdivision of a triangle's edges for an eye, and whether it is drawn as a strip. An
// edge's level depends on the edge alone, so that neighbours share vertices.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CutParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Vertices { vec3 vertices[]; };
layout(scalar) readonly buffer Indices { uint indices[]; };
layout(scalar) writeonly buffer Cuts { uint cuts[]; };  // [eye][slot]

// Triangles are dropped, as the eye's own surface or as edge-on, if they rise above the eye's
// plane, or their plane is off the eye, by at most this fraction of the near distance.
const float kEdgeOn = 1.0 / 16.0;

// Maximum level of edges; all devices' tessellators support 2^6 pieces. Only discs with a radius
// above 996 pixels need more: at 2048 a half circle has an error of 0.62 pixels.
const float kMaxLevel = 6.0;

// Maximum inversion of a strip's piece [pixels]; it bounds the coverage outside the outline.
const float kMaxFold = 1.0 / 16.0;

// Levels are powers of two, so that the tessellator's rings match and inner pieces are hardly
// longer than those at the edges.
uint level_of(float angle)
{
    const float kSmallest = 1e-6;  // angle relative to the chord's
    return uint(clamp(ceil(log2(max(angle / p.chord, kSmallest))), 0.0, kMaxLevel));
}

// A point of the outline: position on the unit disc and height of the direction.
vec3 placed(vec3 ways[3], OutlinePoint at)
{
    const float part = float(at.step) / float(at.steps);
    const vec3 way = on_arc(ways[at.from], ways[at.to], 1.0 - part, part);
    return vec3(on_disc(way), way.z);
}

// True if a piece has the right orientation or is beyond the rim. `facing`: 1 for
// counter-clockwise, else -1.
bool lies_well(vec3 a, vec3 b, vec3 c, float facing)
{
    const vec2 outward = a.xy + b.xy + c.xy;
    if (min(dot(a.xy, outward), min(dot(b.xy, outward), dot(c.xy, outward))) > length(outward))
        return true;
    if (min(a.z, min(b.z, c.z)) < -kDeepest)
        return false;
    const vec2 ab = b.xy - a.xy, ac = c.xy - a.xy, bc = c.xy - b.xy;
    const float longest = sqrt(max(dot(ab, ab), max(dot(ac, ac), dot(bc, bc))));
    return facing * (ab.x * ac.y - ab.y * ac.x) >= -kMaxFold / p.radius * longest;
}

bool lies_well(Strip s, vec3 ways[3], float facing)
{
    if (s.long_end != (s.apex + 1u) % 3u)
        facing = -facing;
    vec3 on_p = placed(ways, on_long(s, 0u)), on_q = placed(ways, on_short(s, 1u));
    uint q = 1u;
    bool well = true;
    for (uint i = 0u; well && i < s.long_steps; ++i) {
        const OutlinePoint opposite = corner_on_long(s, i, 2u);
        if (opposite.step != q) {
            const vec3 next = placed(ways, opposite);
            well = lies_well(next, on_q, on_p, facing);
            on_q = next;
            q = opposite.step;
        }
        const vec3 next = placed(ways, on_long(s, i + 1u));
        well = well && lies_well(on_p, next, on_q, facing);
        on_p = next;
    }
    if (well && q < s.short_steps)
        well = lies_well(placed(ways, on_short(s, q + 1u)), on_q, on_p, facing);
    vec3 on_far = placed(ways, corner_on_far(s, 0u, 1u));
    for (uint i = 0u; well && i + 1u < s.far_steps; ++i) {
        const vec3 next = placed(ways, corner_on_far(s, i, 2u));
        well = lies_well(placed(ways, corner_on_far(s, i, 0u)), on_far, next, facing);
        on_far = next;
    }
    return well;
}

// Tries the apex opposite the shortest edge first: its strip has the shortest pieces.
Cut strip_or_patch(vec3 ways[3], vec3 angles, uvec3 levels, float facing)
{
    const uint shortest = angles.x < angles.y ? (angles.x < angles.z ? 0u : 2u)
                                              : (angles.y < angles.z ? 1u : 2u);
    Cut cut = Cut(kStrip, shortest, levels);
    if (levels == uvec3(0u))
        return cut;
    for (uint i = 0u; i < 3u; ++i) {
        cut.apex = (shortest + i) % 3u;
        if (lies_well(strip_of(cut), ways, facing))
            return cut;
    }
    return Cut(kPatch, shortest, levels);
}

Cut cut_of(Eye eye, vec3 world[3])
{
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    const vec3 a = (world[0] - eye.position) * frame, b = (world[1] - eye.position) * frame,
               c = (world[2] - eye.position) * frame;
    // From world positions, whose differences are exact; local ones would tilt a sliver.
    const vec3 normal = cross(world[1] - world[0], world[2] - world[0]);
    const float height = dot(world[0] - eye.position, normal);
    const float least = kEdgeOn * p.near;
    if (max(a.z, max(b.z, c.z)) <= least || abs(height) <= least * length(normal))
        return Cut(kDropped, 0u, uvec3(0u));
    const vec3 angles = vec3(angle_between(b, c), angle_between(c, a), angle_between(a, b));
    const uvec3 levels = uvec3(level_of(angles.x), level_of(angles.y), level_of(angles.z));
    const vec3 ways[3] = vec3[](normalize(a), normalize(b), normalize(c));
    return strip_or_patch(ways, angles, levels, sign(height));
}

void main()
{
    const uint slots = p.blocks * kCutBlock;
    const uint eye = gl_GlobalInvocationID.x / slots, triangle = gl_GlobalInvocationID.x % slots;
    if (eye >= p.eyes)
        return;
    uint word = kDropped;
    if (triangle < p.triangles) {
        const uint first = p.first_index + 3u * triangle;
        const vec3 world[3] = vec3[](vertices[indices[first]], vertices[indices[first + 1u]],
                                     vertices[indices[first + 2u]]);
        word = packed_cut(cut_of(eyes[p.first_eye + eye], world));
    }
    cuts[(eye * p.eye_blocks + p.first_block) * kCutBlock + triangle] = word;
}
