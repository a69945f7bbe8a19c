#ifndef LUMEL_VISIBILITY_PIXELS_GLSL
#define LUMEL_VISIBILITY_PIXELS_GLSL

// Pixels of an eye's view: projection of points, stored depths, rays. Declares the image of all
// eyes, `views`. The kernel's variant selects the projection.

#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemisphere.glsl"

uniform sampler2D views;

layout(constant_id = 0) const uint kProjection = kHemicube;

// A point projected to a view.
struct ViewPoint {
    vec2 at;     // in pixels, from the corner of the face or of the disc's tile
    vec2 pixel;  // pixel to read
    float z;     // along the face's axis; in a hemisphere the distance
    bool front, along_t, negative;  // face of a hemicube
};

ViewPoint project_to_hemicube(EyeViewLayout tiling, vec3 local)
{
    const vec3 size = abs(local);
    ViewPoint f;
    f.front = local.z >= max(size.x, size.y);
    f.along_t = size.x >= size.y;
    f.negative = (f.along_t ? local.x : local.y) < 0.0;
    f.z = f.front ? local.z : (f.along_t ? size.x : size.y);
    const float right = f.front ? local.x : (f.along_t ? local.y : local.x);
    const float up = f.front ? local.y : local.z;

    const float half_side = 0.5 * float(tiling.side);
    const float per_z = half_side / f.z;
    f.at = vec2(right * per_z + half_side, up * per_z + (f.front ? half_side : 0.0));
    const float rows = f.front ? float(tiling.side) : half_side;
    f.pixel = clamp(floor(f.at), vec2(0.0), vec2(float(tiling.side), rows) - 1.0);
    return f;
}

// Minimum distance of pixel centres from the disc's rim [pixels]: surfaces on the eye's plane end
// at the rim, and their chords half a pixel before.
const float kRim = 0.5;

ViewPoint project_to_hemisphere(EyeViewLayout tiling, vec3 local)
{
    const float kHalfDiagonal = 0.70711;  // distance from pixel centre to corner
    const float radius = 0.5 * float(tiling.side);
    ViewPoint f;
    f.front = true;
    f.along_t = f.negative = false;
    f.z = length(local);
    const vec2 way = local.xy * (radius / f.z);
    f.at = way + radius;
    f.pixel = floor(way * min(1.0, (radius - kRim - kHalfDiagonal) / length(way)) + radius);
    return f;
}

ViewPoint project(EyeViewLayout tiling, vec3 local)
{
    if (kProjection == kHemisphere)
        return project_to_hemisphere(tiling, local);
    return project_to_hemicube(tiling, local);
}

bool is_in_view(EyeViewLayout tiling, ViewPoint f, vec2 pixel)
{
    const float side = float(tiling.side);
    if (kProjection == kHemisphere)
        return distance(pixel + 0.5, vec2(0.5 * side)) <= 0.5 * side - kRim;
    const float rows = f.front ? side : 0.5 * side;
    return all(greaterThanEqual(pixel, vec2(0.0))) && pixel.x < side && pixel.y < rows;
}

// Corner of the point's face in a hemicube's tile [pixels], see eye_views.shared.h.
vec2 face_corner(uint side, ViewPoint f)
{
    if (f.front)
        return vec2(0.0);
    const vec2 first = f.along_t ? vec2(side, 0.0) : vec2(0.0, side);
    const vec2 second = f.along_t ? vec2(0.0, 0.5 * float(side)) : vec2(side, 0.0);
    return f.negative ? first + second : first;
}

float stored_depth(EyeViewLayout tiling, uint tile, ViewPoint f, vec2 pixel)
{
    const uint side = tiling.side;
    const uvec2 size = kProjection == kHemisphere ? uvec2(side)
                                                         : uvec2(2u * side, 3u * side / 2u);
    const uvec2 origin = uvec2(tile % tiling.columns, tile / tiling.columns) * size;
    return texelFetch(views, ivec2(origin) + ivec2(face_corner(side, f) + pixel), 0).r;
}

// The ray through a pixel's centre, up to z = 1 in the stored measure.
vec3 centre_ray(EyeViewLayout tiling, ViewPoint f, vec2 pixel)
{
    if (kProjection == kHemisphere)
        return ray_through(pixel + 0.5, 0.5 * float(tiling.side));
    const vec2 q = (pixel + 0.5) * (2.0 / float(tiling.side)) - vec2(1.0, f.front ? 1.0 : 0.0);
    const float axis = !f.front && f.negative ? -1.0 : 1.0;
    return f.front ? vec3(q, 1.0) : (f.along_t ? vec3(axis, q) : vec3(q.x, axis, q.y));
}

// Half a pixel's width relative to z; on the disc pixels widen toward the horizon.
float half_width(EyeViewLayout tiling, vec3 ray)
{
    return 1.0 / (float(tiling.side) * (kProjection == kHemisphere ? ray.z : 1.0));
}

#endif
