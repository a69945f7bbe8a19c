#version 460
#include "rays/device/bundle_caster.shared.h"
#include "rays/device/bundle_caster.glsl"

// Tests rays against the triangles listed by their pixels and keeps the closest hit so far. The
// lists affect the cost but not the hits.
//
//   [WBW13] S. Woop, C. Benthin, I. Wald. Watertight Ray/Triangle Intersection. 2013.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { BundleCastParams p; };
layout(scalar) readonly buffer Views { BundleView views[]; };
layout(scalar) readonly buffer Positions { vec3 positions[]; };
layout(scalar) readonly buffer Corners { uint corners[]; };
layout(scalar) readonly buffer Heads { uint heads[]; };
layout(scalar) readonly buffer Lists { Listed lists[]; };
layout(scalar) readonly buffer Rays { BundleRay rays[]; };
layout(scalar) buffer Hits { BundleHit hits[]; };

// A vertex in the ray's view. Triangles that share it compute equal values.
vec3 seen(BundleView view, vec3 origin, uint corner)
{
    const vec3 from = positions[corner] - origin;
    precise vec3 at = vec3(dot(view.right, from), dot(view.up, from), dot(view.along, from));
    return at;
}

// Side of an edge on which the ray passes. The reversed edge gives the negated value, so that no
// ray slips between two triangles.
float side_of(vec3 from, vec3 to)
{
    precise float side = from.x * to.y - from.y * to.x;
    return side;
}

// Keeps the triangle if its hit is the closest so far.
void try_triangle(BundleView view, BundleRay ray, uint triangle, inout BundleHit hit)
{
    const vec3 a = seen(view, ray.origin, corners[3u * triangle]);
    const vec3 b = seen(view, ray.origin, corners[3u * triangle + 1u]);
    const vec3 c = seen(view, ray.origin, corners[3u * triangle + 2u]);
    const vec3 weight = vec3(side_of(b, c), side_of(c, a), side_of(a, b));
    const float sum = weight.x + weight.y + weight.z;
    const bool outside = any(lessThan(weight, vec3(0.0))) && any(greaterThan(weight, vec3(0.0)));
    if (outside || sum == 0.0)
        return;
    const vec3 share = weight / sum;
    const float distance = dot(share, vec3(a.z, b.z, c.z));
    const bool nearer = distance < hit.distance ||
                        (distance == hit.distance && triangle < hit.triangle);
    if (distance > ray.near && distance <= ray.far && nearer)
        hit = BundleHit(triangle, distance, share.yz);
}

void main()
{
    if (gl_GlobalInvocationID.x >= p.count)
        return;
    const uint i = p.first + gl_GlobalInvocationID.x;
    const BundleRay ray = rays[i];
    const BundleView view = views[ray.view];
    const vec2 pixel = floor(pixels_of(view, ray.origin));
    if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, vec2(p.side))))
        return;
    BundleHit hit = hits[i];
    const uint row = (ray.view - p.first_view) * p.side + uint(pixel.y);
    for (uint l = heads[row * p.side + uint(pixel.x)]; l != kNoneListed; l = lists[l].next)
        try_triangle(view, ray, lists[l].triangle, hit);
    hits[i] = hit;
}
