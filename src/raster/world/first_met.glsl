#ifndef LUMEL_VISIBILITY_FIRST_MET_GLSL
#define LUMEL_VISIBILITY_FIRST_MET_GLSL

// Visibility of a lumel at its own pixel rays.
//
// A pixel stores exactly the closest surface on the ray through its centre, and nothing about other
// rays. So a lumel is tested where a pixel's ray hits it: there it is compared only with itself,
// and no light leaks. Small or edge-on lumels may have no such point; this view then does not
// decide about them.

// A flat piece of a lumel in a view. The ray through p = (x, y, 1) [pixels] intersects the piece's
// plane at piece coordinates, and at a stored depth, that are ratios of linear forms of p in
// perspective, and linear in a parallel view:
//
//     (u, v) = (u_form·p, v_form·p) / weight·p,        depth = depth_form·p.
struct PieceInView {
    vec3 u_form, v_form, weight, depth_form;
    float steepness;  // depth change of the plane per pixel, in pixel widths
    float rounding;   // rounding error of stored depths
    bool parallelogram;
};

// Corners are rounded to a grid of 1/256 pixel, an error of at most this [pixels] along each axis;
// a plane's stored depth has this error times its slope.
const float kSnap = 1.0 / 512.0;
// Safety factor for further rounding.
const float kSnapSlack = 1.25;

// A ray that hits a piece.
struct RayMet {
    vec2 pixel;
    float chance;  // probability of such a ray: about the piece's area in pixels, at most 1
};

// Safety margin at a piece's edges in its coordinates, which change by du, dv per pixel. At an edge
// with a perpendicular surface, the two depths differ by 2 pixel widths per pixel of margin.
vec2 margin_of(float steepness, vec2 du, vec2 dv)
{
    return kSnap * (2.0 + steepness) * vec2(abs(du.x) + abs(du.y), abs(dv.x) + abs(dv.y));
}

// True if the pixel's ray hits the piece inside the safety margin.
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

// Finds a ray that hits the piece near its point `place` [pixels]. Pixels outside [0, size) are not
// in the view.
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

// True if the piece is the closest hit, given the view's stored depth (nearer is larger).
bool is_first(PieceInView s, RayMet ray, float stored)
{
    const float own = dot(s.depth_form, vec3(ray.pixel + 0.5, 1.0));
    const float slope = abs(s.depth_form.x) + abs(s.depth_form.y);
    return stored <= own + s.rounding + kSnap * kSnapSlack * slope;
}

#endif
