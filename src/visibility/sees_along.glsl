// Does light that comes along a parallel view reach a lumel? Needs parallel_views.shared.h,
// parallel.glsl, world/lumel.glsl and `sampler2D parallel_image` declared.
//
// A pixel tells exactly what its centre's ray meets first. So the point of the lumel is moved to
// where a pixel's centre ray meets its piece, and nothing is left to compare but the piece with
// itself. Only where no such ray meets the piece, the pixels around the point decide, and all of
// them must agree that the light arrives: rather a shadow that is a pixel too wide than a leak.

// Corners are drawn where a grid of 1/256 pixel lets them be: what stands back from a piece's edges
// by twice that [pixels] is inside for certain, and a plane's depth is off by as many pixels' slope.
const float kSnap = 1.0 / 128.0;
// Rounding of stored depths, which lie in 0…1.
const float kDepthRounding = 1e-6;

float first_nearness(ParallelLayout layout_, uint tile, vec2 pixel)
{
    const vec2 corner =
        vec2(tile % layout_.columns, tile / layout_.columns) * float(layout_.side);
    const vec2 inside = clamp(pixel, vec2(0.0), vec2(float(layout_.side) - 1.0));
    return texelFetch(parallel_image, ivec2(corner + inside), 0).x;
}

bool light_arrives(ParallelLayout layout_, uint tile, ParallelView view, Piece piece, vec3 point)
{
    const vec2 at = place_in(view, point);
    const vec2 u = vec2(dot(view.right, piece.edge_u), dot(view.up, piece.edge_u));
    const vec2 v = vec2(dot(view.right, piece.edge_v), dot(view.up, piece.edge_v));
    const float area = u.x * v.y - u.y * v.x;  // of the parallelogram in the view [pixels²]
    const float nearness = nearness_in(view, point);
    const vec2 along = vec2(dot(view.toward, piece.edge_u), dot(view.toward, piece.edge_v));
    // How the plane comes nearer per pixel.
    const vec2 slope = vec2(along.x * v.y - along.y * u.y, along.y * u.x - along.x * v.x) / area;
    const float slack = kDepthRounding + kSnap * (abs(slope.x) + abs(slope.y));

    // The pixel's own ray, in the piece's coordinates.
    const vec2 pixel = floor(at);
    const vec2 way = pixel + 0.5 - place_in(view, piece.origin);
    const vec2 inside = vec2(way.x * v.y - way.y * v.x, way.y * u.x - way.x * u.y) / area;
    // By how much a snap moves them.
    const vec2 margin =
        kSnap * vec2(abs(v.x) + abs(v.y), abs(u.x) + abs(u.y)) / abs(area);
    const bool meets =
        all(greaterThan(inside, margin)) &&
        (piece.parallelogram != 0u ? all(lessThan(inside, 1.0 - margin))
                                   : inside.x + inside.y < 1.0 - margin.x - margin.y);
    if (meets)
        return first_nearness(layout_, tile, pixel) <=
               nearness + dot(slope, pixel + 0.5 - at) + slack;

    const vec2 first = floor(at - 0.5);
    bool open = true;
    for (uint k = 0u; k < 4u; ++k) {
        const vec2 next = first + vec2(k % 2u, k / 2u);
        open = open && first_nearness(layout_, tile, next) <=
                           nearness + dot(slope, next + 0.5 - at) + slack;
    }
    return open;
}
