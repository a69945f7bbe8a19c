#ifndef LUMEL_VISIBILITY_RAYS_ALONG_GLSL
#define LUMEL_VISIBILITY_RAYS_ALONG_GLSL

// All pixel rays of a parallel view that hit a piece of a lumel.
//
// For a lumel crossed by a shadow edge, the accuracy of the lit fraction depends on the
// uniformity of the test points. The rays' hits are uniform, and each represents the
// area of a pixel.

#include "raster/parallel/piece_along.glsl"

struct RaysAlong {
    vec3 sides[4];  // a ray through p hits the piece if all dot(side, p) > 0
    vec2 rows;      // first and last row [pixels]
    float area;     // area of the piece [pixels]
    float mean;     // number of rays that hit it, averaged over shifts of the pixel grid
    float width;    // width of the valid region across its longest side [pixels]
};

// Smaller projected areas are omitted [pixels].
const float kMinArea = 1e-6;

RaysAlong rays_along(ParallelView view, ParallelLayout tiling, Piece piece, PieceInView s)
{
    const vec2 margin = margin_of(s.steepness, s.u_form.xy, s.v_form.xy);
    const vec3 one = vec3(0.0, 0.0, 1.0);
    const vec3 end = s.parallelogram ? (1.0 - margin.x) * one - s.u_form
                                     : (1.0 - margin.x - margin.y) * one - s.u_form - s.v_form;
    RaysAlong rays;
    rays.sides = vec3[4](s.u_form - margin.x * one, s.v_form - margin.y * one, end,
                         s.parallelogram ? (1.0 - margin.y) * one - s.v_form : end);

    const vec2 u = vec2(dot(view.right, piece.edge_u), dot(view.up, piece.edge_u));
    const vec2 v = vec2(dot(view.right, piece.edge_v), dot(view.up, piece.edge_v));
    const vec4 corners = place_in(view, piece.origin).y +
                         vec4(0.0, u.y, v.y, s.parallelogram ? u.y + v.y : 0.0);
    const float low = min(min(corners.x, corners.y), min(corners.z, corners.w));
    const float high = max(max(corners.x, corners.y), max(corners.z, corners.w));
    rays.area = (s.parallelogram ? 1.0 : 0.5) /
                abs(s.u_form.x * s.v_form.y - s.u_form.y * s.v_form.x);
    const vec2 rows = clamp(vec2(ceil(low - 0.5), floor(high - 0.5)), vec2(0.0),
                            vec2(tiling.side) - 1.0);
    const vec2 inner = max(1.0 - 2.0 * margin, 0.0);
    const float leg = max(1.0 - 2.0 * (margin.x + margin.y), 0.0);
    rays.mean = rays.area * (s.parallelogram ? inner.x * inner.y : leg * leg);
    rays.width = rays.mean / max(length(u), length(v));
    rays.rows = rays.area > kMinArea ? rows : vec2(0.0, -1.0);
    return rays;
}

// First and last pixel of a row whose rays hit the piece; last < first if there are none.
vec2 columns_of(RaysAlong rays, ParallelLayout tiling, float row)
{
    float low = 0.5, high = float(tiling.side) - 0.5;
    for (uint k = 0u; k < 4u; ++k) {
        const vec3 side = rays.sides[k];
        const float there = side.y * (row + 0.5) + side.z;
        if (side.x > 0.0)
            low = max(low, -there / side.x);
        else if (side.x < 0.0)
            high = min(high, -there / side.x);
        else if (there <= 0.0)
            high = -1.0;
    }
    return vec2(ceil(low - 0.5), floor(high - 0.5));
}

float count_rays(RaysAlong rays, ParallelLayout tiling)
{
    float count = 0.0;
    for (float y = rays.rows.x; y <= rays.rows.y; y += 1.0) {
        const vec2 columns = columns_of(rays, tiling, y);
        count += max(columns.y - columns.x + 1.0, 0.0);
    }
    return count;
}

// The pixel of ray `index` of count_rays().
vec2 nth_ray(RaysAlong rays, ParallelLayout tiling, float index)
{
    for (float y = rays.rows.x; y <= rays.rows.y; y += 1.0) {
        const vec2 columns = columns_of(rays, tiling, y);
        const float here = max(columns.y - columns.x + 1.0, 0.0);
        if (index < here)
            return vec2(columns.x + index, y);
        index -= here;
    }
    return vec2(-1.0);
}

#endif
