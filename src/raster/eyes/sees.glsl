#ifndef LUMEL_VISIBILITY_SEES_GLSL
#define LUMEL_VISIBILITY_SEES_GLSL

// Visibility of a point from an eye.

#include "raster/eyes/pixels.glsl"

// Relative tolerance of depth comparisons: stored depths are interpolated as floats, and a
// receiver's pieces approximate the rendered surface.
const float kDepthSlack = 2e-4;
// Maximum relative distance of a curved receiver's adjacent facets behind its plane.
const float kPlaneSlack = 2e-3;
// If a plane is nearer at the pixel's centre than at the point by more than half this number of
// pixel widths, relative to z, a depth match is weak evidence: a steep plane intersects many
// others.
const float kSlope = 2.0;
// Beyond this, it is no evidence.
const float kMaxSlope = 8.0;
// Maximum error of rasterised positions [pixels]: corners are rounded to 1/256, and interpolation
// adds an error.
const float kRounding = 1.0 / 128.0;

// Maximum relative distance of the facet beyond a convex edge behind the receiver's plane.
const float kEdgeSlack = 0.016;
// Pixels count as flat if their depth steps agree to this fraction.
const float kFlatness = 0.1;

// Distance of the receiver's plane behind a pixel's stored depth (negative if in front), times
// toward_point. Affine over the pixels of one plane; in a hemisphere nearly so, except at its rim.
float in_front_of_plane(EyeViewLayout tiling, ViewPoint f, vec2 pixel, float stored, vec3 facing,
                        float toward_point)
{
    return stored * toward_point + dot(facing, centre_ray(tiling, f, pixel)) * tiling.near;
}

// The pixel's centre has another surface, `in_front` of the receiver's `plane`, but the next pixel
// toward the point may not. True if the point is on the next pixel's side of the line between the
// two surfaces.
bool is_past_edge(EyeViewLayout tiling, uint tile, ViewPoint f, vec3 facing, float toward_point,
                  float in_front, float plane)
{
    const vec2 offset = f.at - f.pixel - 0.5;
    const vec2 side = abs(offset.x) > abs(offset.y) ? vec2(sign(offset.x), 0.0)
                                                   : vec2(0.0, sign(offset.y));
    if (!is_in_view(tiling, f, f.pixel + side) || !is_in_view(tiling, f, f.pixel - 2.0 * side))
        return false;
    // The next pixel must have the receiver's own surface, or none: surfaces on the scene's hull
    // are not rendered.
    const float next_stored = stored_depth(tiling, tile, f, f.pixel + side);
    const float next =
        in_front_of_plane(tiling, f, f.pixel + side, next_stored, facing, toward_point);
    if (next > plane * kDepthSlack || (next_stored > 0.0 && next < -plane * kPlaneSlack))
        return false;
    // A convex edge: the other facet is a little behind the plane.
    if (in_front <= 0.0)
        return in_front > -plane * kEdgeSlack;
    // A contact: the other surface, extrapolated from the previous pixels, reaches the plane before
    // the point.
    const float before =
        in_front_of_plane(tiling, f, f.pixel - side, stored_depth(tiling, tile, f, f.pixel - side),
                          facing, toward_point);
    const float first = in_front_of_plane(
        tiling, f, f.pixel - 2.0 * side, stored_depth(tiling, tile, f, f.pixel - 2.0 * side),
        facing, toward_point);
    const float step = in_front - before;
    const bool is_flat = abs(step - (before - first)) <= kFlatness * abs(step);
    return is_flat && in_front + step * dot(offset, side) <= plane * kDepthSlack;
}

// True if the receiver's plane is also visible beside the pixel, toward the eye or away from it.
// Another surface intersects the plane only in a line.
bool is_plane_beside(EyeViewLayout tiling, uint tile, ViewPoint f, vec3 facing, float toward_point,
                     float plane)
{
    const float right = -dot(facing, centre_ray(tiling, f, f.pixel + vec2(1.0, 0.0)));
    const float up = -dot(facing, centre_ray(tiling, f, f.pixel + vec2(0.0, 1.0)));
    const float here = plane / tiling.near;
    const vec2 side = abs(right - here) > abs(up - here) ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    bool shown = false;
    for (float toward = -1.0; toward <= 1.0; toward += 2.0) {
        const vec2 pixel = f.pixel + toward * side;
        const float found = in_front_of_plane(tiling, f, pixel,
                                              stored_depth(tiling, tile, f, pixel), facing,
                                              toward_point);
        shown = shown || (is_in_view(tiling, f, pixel) && abs(found) <= plane * kPlaneSlack);
    }
    return shown;
}

// True if a steep plane is visible at all four pixel centres around the point. Over the pixels, the
// plane and any flat occluder are affine in 1 / z. An occluder that covers the four and is nearer
// than the plane at the point is nearer at one of them at least, so none can hide the point alone.
bool is_free_around(EyeViewLayout tiling, uint tile, ViewPoint f, vec3 facing, float toward_point)
{
    const vec2 corner = floor(f.at - 0.5);
    float plane[4], most = -1e30, least = 1e30;
    for (uint i = 0u; i < 4u; ++i) {
        const vec2 pixel = corner + vec2(i & 1u, i >> 1u);
        plane[i] = -dot(facing, centre_ray(tiling, f, pixel)) * tiling.near;
        most = max(most, plane[i]);
        least = min(least, plane[i]);
    }
    bool free = true;
    for (uint i = 0u; i < 4u; ++i) {
        const vec2 pixel = corner + vec2(i & 1u, i >> 1u);
        const float slack = abs(plane[i]) * kDepthSlack + (most - least) * kRounding;
        free = free && is_in_view(tiling, f, pixel) &&
               stored_depth(tiling, tile, f, pixel) * toward_point <= plane[i] + slack;
    }
    return free;
}

// V between the eye of tile `tile` and the point at eye + (t, b, n)·local on a surface whose
// normal is `facing` (any length) in the eye's frame.
//
// The pixel with the point stores near / z of the closest surface along the pixel's centre ray,
// with z along a hemicube face's axis or the distance. That ray intersects the receiver's plane at
//
//     z_plane = (facing · local) / (facing · q),      q = the ray to z = 1,
//
// If this is the stored depth, the pixel has the receiver's own surface: the point is visible.
// Otherwise the point's own z decides, as in any shadow map, except beside edges and contacts. The
// plane must match exactly: it may be in front of an occluder that hides the point. At grazing
// angles the pixel's neighbours are read too.
bool sees(EyeViewLayout tiling, uint tile, vec3 local, vec3 facing)
{
    const ViewPoint f = project(tiling, local);
    const float stored = stored_depth(tiling, tile, f, f.pixel);
    if (stored * f.z <= tiling.near * (1.0 + kDepthSlack))
        return true;
    const float toward_point = -dot(facing, local);
    const vec3 ray = centre_ray(tiling, f, f.pixel);
    const float toward_pixel = -dot(facing, ray);
    const float plane = toward_pixel * tiling.near;
    const float in_front = toward_point * stored - plane;
    const float width = half_width(tiling, ray);
    if (toward_point < (1.0 - kMaxSlope * width) * f.z * toward_pixel)
        return in_front <= plane * kEdgeSlack &&  // else already occluded at this pixel
               is_free_around(tiling, tile, f, facing, toward_point);
    if (in_front <= plane * kDepthSlack && in_front >= -plane * kPlaneSlack)
        return toward_point >= (1.0 - kSlope * width) * f.z * toward_pixel ||
               is_plane_beside(tiling, tile, f, facing, toward_point, plane);
    return is_past_edge(tiling, tile, f, facing, toward_point, in_front, plane);
}

#endif
