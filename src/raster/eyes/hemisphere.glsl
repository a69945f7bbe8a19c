#ifndef LUMEL_VISIBILITY_HEMISPHERE_GLSL
#define LUMEL_VISIBILITY_HEMISPHERE_GLSL

// Hemispherical projection [BJ04], section 3.2: a direction falls on the disc at its (t, b).
// Points here are in the eye's frame (t, b, n).
//
// Seen from the eye, an edge is an arc of a great circle: on the disc, of an ellipse. A straight
// line in place of an arc of angle δ is off by at most
//
//     radius (1 - cos(δ/2))
//
// pixels: so far are arc and chord apart on the unit sphere, and projecting shortens. Cut into
// pieces of equal angle, an edge needs at most π/δ of them, however near the eye it passes.
//
// Differs from the paper, which projects the vertices of a scene that is tessellated as it comes:
// - Triangles are cut for each eye, by what their edges subtend.
// - Stored is the distance, of the pixel's centre, not -z interpolated between vertices.

// Any order that two triangles agree on for the edge they share.
bool comes_first(vec3 a, vec3 b)
{
    return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z);
}

float angle_between(vec3 a, vec3 b)
{
    const bool in_order = comes_first(a, b);
    const vec3 first = in_order ? a : b, second = in_order ? b : a;
    return atan(length(cross(first, second)), dot(first, second));
}

// The direction at parts `part_a`, `part_b` (sum 1) of the angle from a to b, which have length 1:
// the same bits whichever comes first.
vec3 on_arc(vec3 a, vec3 b, float part_a, float part_b)
{
    if (part_b == 0.0)
        return a;
    if (part_a == 0.0)
        return b;
    const float kSmallest = 1e-6;  // there the sines are their arguments
    const float angle = max(angle_between(a, b), kSmallest);
    const bool in_order = comes_first(a, b);
    precise const vec3 first = (in_order ? a : b) * sin((in_order ? part_a : part_b) * angle);
    precise const vec3 second = (in_order ? b : a) * sin((in_order ? part_b : part_a) * angle);
    precise const vec3 sum = first + second;
    return normalize(sum);
}

// Where a direction falls on the disc of radius 1. Below the horizon it goes on outwards, so that
// triangles that cross the horizon need not be cut there.
vec2 on_disc(vec3 direction)
{
    const float kSmallest = 1e-6;  // straight down has no place: it is clipped
    const float reach = max(length(direction.xy), kSmallest);
    return direction.z >= 0.0 ? direction.xy : direction.xy * (2.0 / reach - 1.0);
}

// What lies deeper below the horizon than this [of a direction's length 1] is clipped: the disc is
// torn there.
const float kDeepest = 0.5;

// Where a direction is drawn. The fragments write the depth; this one clips.
vec4 projected(vec3 way)
{
    return vec4(on_disc(way), 0.5 * (way.z + kDeepest), 1.0);
}

// The ray through a point of the image, length 1; `at` in pixels from the tile's corner.
vec3 ray_through(vec2 at, float radius)
{
    const vec2 q = at / radius - 1.0;
    return vec3(q, sqrt(max(1.0 - dot(q, q), 0.0)));
}

#endif
