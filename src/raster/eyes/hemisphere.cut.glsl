#ifndef LUMEL_VISIBILITY_HEMISPHERE_CUT_GLSL
#define LUMEL_VISIBILITY_HEMISPHERE_CUT_GLSL

// Subdivision of a triangle for an eye, packed into one word, and the resulting strip.
//
// Only the edges of a triangle are curved: distances are exact per pixel, so no inner points are
// needed. A strip between two edges from a corner, the apex, and a fan over the chord of the third
// edge fill the outline with two pieces less than there are edge pieces; the tessellator's rings
// take their square.

#include "raster/eyes/hemisphere.glsl"

const uint kDropped = 0u;  // below the horizon, edge-on, or too near
const uint kStrip = 1u;    // whole triangles are strips of one piece
const uint kPatch = 2u;    // strips would fold: tessellated

struct Cut {
    uint kind;
    uint apex;      // apex of a strip
    uvec3 levels;   // log2 of the pieces of the edge opposite each corner
};

uint packed_cut(Cut cut)
{
    return cut.kind | cut.apex << 2 | cut.levels.x << 4 | cut.levels.y << 7 | cut.levels.z << 10;
}

Cut unpacked_cut(uint word)
{
    return Cut(word & 3u, word >> 2 & 3u, uvec3(word >> 4, word >> 7, word >> 10) & 7u);
}

// The two edges from the apex, the one with more pieces first, and the third.
struct Strip {
    uint apex, long_end, short_end;
    uint long_steps, short_steps, far_steps;
};

Strip strip_of(Cut cut)
{
    const uint next = (cut.apex + 1u) % 3u, last = (cut.apex + 2u) % 3u;
    const uint to_next = 1u << cut.levels[last], to_last = 1u << cut.levels[next];
    const bool in_order = to_next >= to_last;
    return Strip(cut.apex, in_order ? next : last, in_order ? last : next,
                 max(to_next, to_last), min(to_next, to_last), 1u << cut.levels[cut.apex]);
}

uint pieces_of(Strip s)
{
    return s.long_steps + s.short_steps + s.far_steps - 2u;
}

// A point of an outline: `step` of `steps` from one corner to another.
struct OutlinePoint {
    uint from, to, step, steps;
};

OutlinePoint on_long(Strip s, uint i)
{
    return OutlinePoint(s.apex, s.long_end, i, s.long_steps);
}

OutlinePoint on_short(Strip s, uint i)
{
    return OutlinePoint(s.apex, s.short_end, i, s.short_steps);
}

// Pieces of a strip, first those based on a step of the long edge,
OutlinePoint corner_on_long(Strip s, uint step, uint corner)
{
    const uint ratio = s.long_steps / s.short_steps;
    const uint opposite = max((step + ratio / 2u) / ratio, 1u);
    return corner < 2u ? on_long(s, step + corner) : on_short(s, opposite);
}

// then those based on a step of the short edge, except at the apex,
OutlinePoint corner_on_short(Strip s, uint step, uint corner)
{
    const uint ratio = s.long_steps / s.short_steps;
    const uint opposite = (step + 1u) * ratio - ratio / 2u;
    return corner < 2u ? on_short(s, step + 1u - corner) : on_long(s, opposite);
}

// then those of the fan over the far edge's chord.
OutlinePoint corner_on_far(Strip s, uint step, uint corner)
{
    return OutlinePoint(s.long_end, s.short_end, corner == 0u ? 0u : step + corner, s.far_steps);
}

OutlinePoint strip_corner(Strip s, uint piece, uint corner)
{
    if (piece < s.long_steps)
        return corner_on_long(s, piece, corner);
    const uint beyond = piece - s.long_steps;
    if (beyond + 1u < s.short_steps)
        return corner_on_short(s, beyond + 1u, corner);
    return corner_on_far(s, beyond + 1u - s.short_steps, corner);
}

#endif
