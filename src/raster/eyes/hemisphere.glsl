#ifndef LUMEL_VISIBILITY_HEMISPHERE_GLSL
#define LUMEL_VISIBILITY_HEMISPHERE_GLSL

// Hemispherical projection [BJ04], section 3.2: a direction is at (t, b) on the disc. Points are in
// the eye's frame (t, b, n).
//
// An edge projects to an arc of a great circle, on the disc to an arc of an ellipse. A straight
// line that replaces an arc of angle δ has an error of at most
//
//     radius (1 - cos(δ/2))
//
// pixels: this is the distance of arc and chord on the unit sphere, and projection shortens it. In
// pieces of equal angle, an edge needs at most π/δ of them, at any distance from the eye.
//
// Differs from the paper, which projects the vertices of a given tessellation:
// - Triangles are subdivided per eye, by the angles of their edges.
// - The distance at the pixel's centre is stored, not -z interpolated between vertices.

// Any order that two triangles agree on for a shared edge.
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

// Direction at the fractions `part_a` and `part_b` (sum 1) of the angle between unit directions a
// and b: bitwise equal if both are swapped.
vec3 on_arc(vec3 a, vec3 b, float part_a, float part_b)
{
    if (part_b == 0.0)
        return a;
    if (part_a == 0.0)
        return b;
    const float kSmallest = 1e-6;  // below this, sines equal their arguments
    const float angle = max(angle_between(a, b), kSmallest);
    const bool in_order = comes_first(a, b);
    precise const vec3 first = (in_order ? a : b) * sin((in_order ? part_a : part_b) * angle);
    precise const vec3 second = (in_order ? b : a) * sin((in_order ? part_b : part_a) * angle);
    precise const vec3 sum = first + second;
    return normalize(sum);
}

// Position of a direction on the unit disc. Below the horizon it continues outwards, so that
// triangles need not be clipped there.
vec2 on_disc(vec3 direction)
{
    const float kSmallest = 1e-6;  // straight down has no position: it is clipped
    const float reach = max(length(direction.xy), kSmallest);
    return direction.z >= 0.0 ? direction.xy : direction.xy * (2.0 / reach - 1.0);
}

// Directions deeper below the horizon than this are clipped: the disc's map is singular there.
const float kDeepest = 0.5;

// Clip position of a direction. It only clips; fragments write the depth.
vec4 projected(vec3 way)
{
    return vec4(on_disc(way), 0.5 * (way.z + kDeepest), 1.0);
}

// Unit ray through a point of the image; `at` in pixels from the tile's corner.
vec3 ray_through(vec2 at, float radius)
{
    const vec2 q = at / radius - 1.0;
    return vec3(q, sqrt(max(1.0 - dot(q, q), 0.0)));
}

#endif
