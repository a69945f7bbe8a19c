#version 460
#include "raster/shadow_maps/parallel_light.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/world/channel.glsl"
#include "raster/parallel/parallel.glsl"
#include "raster/world/first_met.glsl"
#include "raster/parallel/piece_along.glsl"
#include "raster/parallel/rays_along.glsl"

// Every lumel receives light of K directions:
//
//     H = Σ_k  illuminance_k · V_k · max(cosθ_k, 0).
//
// With coloured glass V depends on the channel, and each view has one. V is summed as described in
// light_sums.shared.h; P is the mean number of rays that hit a lumel, because all of them count.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { ParallelReceiveParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(scalar) readonly buffer Sources { ParallelSource sources[]; };
uniform sampler2D parallel_image;
layout(scalar) buffer Sums { LightSums sums[]; };

// Maximum pieces tested per lumel; of more, this number is sampled.
const uint kMaxPieces = 4u;
// Approximate maximum of rays tested per piece; the rest is skipped.
const float kMaxRays = 64.0;

bool is_lit(PieceInView piece, uint tile, vec2 pixel)
{
    const ivec2 place = ivec2(tile_corner(p.tiling, tile)) + ivec2(pixel);
    return is_first(piece, RayMet(pixel, 1.0), texelFetch(parallel_image, place, 0).x);
}

// Rays that hit a piece, and those of them that are lit, normalised to 1 for all on average.
// `random`: selects the skipped rays.
vec2 rays_of(ParallelView view, uint tile, Piece piece, uint random)
{
    const PieceInView s = piece_along(view, piece);
    const RaysAlong rays = rays_along(view, p.tiling, piece, s);
    const float stride = max(ceil(sqrt(rays.area / kMaxRays)), 1.0);
    const vec2 start = floor(stride * vec2(unit_float(random), unit_float(hash(random))));
    float met = 0.0, lit = 0.0;
    for (float y = rays.rows.x + start.y; y <= rays.rows.y; y += stride) {
        const vec2 columns = columns_of(rays, p.tiling, y);
        for (float x = columns.x + start.x; x <= columns.y; x += stride) {
            met += 1.0;
            if (is_lit(s, tile, vec2(x, y)))
                lit += 1.0;
        }
    }
    return vec2(met, lit) * (stride * stride / rays.area);
}

// Those sums for only the ray next to a lumel's centroid.
vec2 ray_of(ParallelView view, uint tile, Piece piece, vec3 middle)
{
    const PieceInView s = piece_along(view, piece);
    RayMet ray;
    if (!find_ray(s, place_in(view, middle), vec2(p.tiling.side), ray))
        return vec2(0.0);
    return vec2(1.0, is_lit(s, tile, ray.pixel) ? 1.0 : 0.0) / ray.chance;
}

uint pieces_asked(Lumel lumel)
{
    return p.centre != 0u ? 1u : min(lumel.piece_count, kMaxPieces);
}

// The n-th tested piece and its share of the lumel. `draw`: index of the sample, different for each
// piece of a lumel.
Piece piece_asked(Lumel lumel, uint i, uint n, uint draw, out float share)
{
    if (p.centre == 0u && lumel.piece_count <= kMaxPieces) {
        const Piece piece = pieces[lumel.first_piece + n];
        share = n == 0u ? piece.share : piece.share - pieces[lumel.first_piece + n - 1u].share;
        return piece;
    }
    const LumelPoint point = receiving_point(lumel, i, draw, p.seed, p.centre != 0u);
    Piece piece = pieces[point.piece];
    piece.normal = point.normal;
    share = 1.0 / float(pieces_asked(lumel));
    return piece;
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    const uint asked = pieces_asked(lumel);
    LightSums sum = sums[i];
    for (uint ask = 0u; ask < p.views * asked; ++ask) {
        const uint k = ask / asked, index = (p.first_view + k) / p.views_per_source;
        const ParallelView view = views[p.first_view + k];
        const ParallelSource source = sources[index];
        const uint draw = index * asked + ask % asked;
        float share;
        const Piece piece = piece_asked(lumel, i, ask % asked, draw, share);
        const float cosine = dot(piece.normal, source.toward);
        const vec3 facing = cross(piece.edge_u, piece.edge_v);
        if (cosine <= 0.0 || dot(facing, source.toward) <= 0.0)
            continue;
        const vec3 open = share * cosine * source.illuminance * carried(view.channel);
        const vec2 rays = p.centre != 0u ? ray_of(view, k, piece, lumel.position)
                                         : rays_of(view, k, piece, hash(i ^ hash(draw ^ p.seed)));
        sum.open += open;
        sum.known += open * rays.x;
        sum.arrived += open * rays.y;
    }
    sums[i] = sum;
}
