#ifndef LUMEL_VISIBILITY_FIRST_MET_GLSL
#define LUMEL_VISIBILITY_FIRST_MET_GLSL

// Is a lumel the first thing that light meets?
//
// A pixel stores exactly what the ray through its centre meets first, and nothing about the rays
// beside it. So a lumel is tested at a point where a pixel's ray meets it: there it is compared
// only with itself, and no light can leak. Lumels that are small or
// seen from the side may have no such point; then this view does not decide about them.

// A flat piece of a lumel in a view. Where the ray through a place p = (x, y, 1) [pixels] meets the
// piece's plane, in the piece's coordinates and in the depth that the view stores, is a ratio of
// linear forms of p in a perspective, and linear in a parallel view:
//
//     (u, v) = (u_form·p, v_form·p) / weight·p,        depth = depth_form·p.
struct PieceInView {
    vec3 u_form, v_form, weight, depth_form;
    float steepness;  // by how many pixels' widths the plane comes nearer per pixel
    float rounding;   // of stored depths
    bool parallelogram;
};

// Corners are drawn where a grid of 1/256 pixel lets them be, so at most this far off [pixels]
// along each axis; a plane's stored depth is off by as much times its slope.
const float kSnap = 1.0 / 512.0;
// Room for the rounding beside it.
const float kSnapSlack = 1.25;

// A ray that meets a piece.
struct RayMet {
    vec2 pixel;
    float chance;  // that a view has one that meets the piece: about its area in pixels, at most 1
};

// A safe distance from a piece's edges in its coordinates, which change by du, dv per pixel. Where
// another surface meets an edge at a right angle, the two differ in depth by 2 pixels' widths for
// every pixel of that distance.
vec2 margin_of(float steepness, vec2 du, vec2 dv)
{
    return kSnap * (2.0 + steepness) * vec2(abs(du.x) + abs(du.y), abs(dv.x) + abs(dv.y));
}

// Does the pixel's ray meet the piece, at a safe distance from its edges?
bool meets(PieceInView s, vec2 pixel, out float area)
{
    const vec3 p = vec3(pixel + 0.5, 1.0);
    const float w = 1.0 / dot(s.weight, p);
    const vec2 at = vec2(dot(s.u_form, p), dot(s.v_form, p)) * w;
    const vec2 du = (s.u_form.xy - at.x * s.weight.xy) * w;  // per pixel
    const vec2 dv = (s.v_form.xy - at.y * s.weight.xy) * w;
    area = (s.parallelogram ? 1.0 : 0.5) / abs(du.x * dv.y - du.y * dv.x);
    const vec2 margin = margin_of(s.steepness, du, dv);
    return w > 0.0 && all(greaterThan(at, margin)) &&
           (s.parallelogram ? all(lessThan(at, 1.0 - margin))
                            : at.x + at.y < 1.0 - margin.x - margin.y);
}

// Searches for a ray that meets the piece near `place` [pixels], a point of it. Pixels outside
// [0, size) are not in the view.
bool find_ray(PieceInView s, vec2 place, vec2 size, out RayMet ray)
{
    const vec2 here = clamp(floor(place), vec2(0.0), size - 1.0);
    float area;
    bool found = meets(s, here, area);
    ray = RayMet(here, min(area, 1.0));
    for (uint k = 0u; k < 9u; ++k) {
        const vec2 next = here + vec2(k % 3u, k / 3u) - 1.0;
        if (!found && all(greaterThanEqual(next, vec2(0.0))) && all(lessThan(next, size)) &&
            meets(s, next, area)) {
            found = true;
            ray = RayMet(next, min(area, 1.0));
        }
    }
    return found;
}

// Is the piece the first that the ray meets, if the view stores this depth (nearer is larger)?
bool is_first(PieceInView s, RayMet ray, float stored)
{
    const float own = dot(s.depth_form, vec3(ray.pixel + 0.5, 1.0));
    const float slope = abs(s.depth_form.x) + abs(s.depth_form.y);
    return stored <= own + s.rounding + kSnap * kSnapSlack * slope;
}

#endif
