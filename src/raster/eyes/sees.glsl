#ifndef LUMEL_VISIBILITY_SEES_GLSL
#define LUMEL_VISIBILITY_SEES_GLSL

// Does an eye see a point?

#include "raster/eyes/pixels.glsl"

// Relative slack of the depth comparison: stored depths are interpolated in float, and a
// receiver's pieces approximate the drawn surface.
const float kDepthSlack = 2e-4;
// A curved receiver's neighbouring facets fall behind its plane by this much at most, relative.
const float kPlaneSlack = 2e-3;
// If a plane is nearer at the pixel's centre than at the point by more than half this number of
// pixel widths, as a part of z, being on it there means little: a steep plane meets many others.
const float kSlope = 2.0;
// And by more than this it means nothing.
const float kMaxSlope = 8.0;
// What is drawn may be off by this much [pixels]: corners are rounded to 1/256, and interpolation
// adds its own.
const float kRounding = 1.0 / 128.0;

// The facet beyond a convex edge falls behind the receiver's plane by this much at most, relative.
const float kEdgeSlack = 0.016;
// What pixels show counts as flat if its depth's steps agree to this part.
const float kFlatness = 0.1;

// How far the receiver's plane runs behind what a pixel stores (in front of it: below 0), times
// toward_point. Affine over the pixels of one flat surface; in a hemisphere nearly, but at its rim.
float in_front_of_plane(EyeViewLayout tiling, ViewPoint f, vec2 pixel, float stored, vec3 facing,
                        float toward_point)
{
    return stored * toward_point + dot(facing, centre_ray(tiling, f, pixel)) * tiling.near;
}

// The pixel's centre shows another surface, `in_front` of the receiver's `plane`, but the next
// pixel toward the point may not: does the point lie on the next pixel's side of the line between
// the two?
bool is_past_edge(EyeViewLayout tiling, uint tile, ViewPoint f, vec3 facing, float toward_point,
                  float in_front, float plane)
{
    const vec2 offset = f.at - f.pixel - 0.5;
    const vec2 side = abs(offset.x) > abs(offset.y) ? vec2(sign(offset.x), 0.0)
                                                   : vec2(0.0, sign(offset.y));
    if (!is_in_view(tiling, f, f.pixel + side) || !is_in_view(tiling, f, f.pixel - 2.0 * side))
        return false;
    // The next pixel must show the receiver's own surface, or nothing: surfaces on the scene's hull
    // are not drawn.
    const float next_stored = stored_depth(tiling, tile, f, f.pixel + side);
    const float next =
        in_front_of_plane(tiling, f, f.pixel + side, next_stored, facing, toward_point);
    if (next > plane * kDepthSlack || (next_stored > 0.0 && next < -plane * kPlaneSlack))
        return false;
    // A convex edge: the other facet lies a little behind the plane.
    if (in_front <= 0.0)
        return in_front > -plane * kEdgeSlack;
    // A contact: the other surface comes down to the plane before the point is reached, if it
    // goes on as it does over the pixels before.
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

// Does the receiver's plane show beside the pixel as well, toward the eye or away from it? Another
// surface meets the plane in a line, and off that line leaves it.
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

// Is a steep plane seen at all four pixel centres around the point? Over the pixels, the plane and
// any flat occluder are affine in 1 / z. An occluder that covers the four and is nearer than the
// plane at the point is nearer at one of them at least: none can hide the point alone.
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
// The pixel that holds the point stores near / z of the nearest surface along the pixel's
// centre, z along a hemicube face's axis or the distance. The receiver's plane is met by that same
// centre ray at
//
//     z_plane = (facing · local) / (facing · q),      q = the ray to z = 1,
//
// and if that is what is stored, the pixel shows the receiver's own surface: it is seen. Otherwise
// the point's own z decides, as in any shadow map, but for points beside an edge or a contact. Only
// equality counts for the plane: it may well run in front of an occluder that hides the point
// itself. At grazing angles one pixel is not enough: its neighbours are read as well.
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
        return in_front <= plane * kEdgeSlack &&  // else hidden at this pixel already
               is_free_around(tiling, tile, f, facing, toward_point);
    if (in_front <= plane * kDepthSlack && in_front >= -plane * kPlaneSlack)
        return toward_point >= (1.0 - kSlope * width) * f.z * toward_pixel ||
               is_plane_beside(tiling, tile, f, facing, toward_point, plane);
    return is_past_edge(tiling, tile, f, facing, toward_point, in_front, plane);
}

#endif
