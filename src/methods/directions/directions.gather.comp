#version 460
#include "methods/directions/directions.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/world/channel.glsl"
#include "raster/parallel/parallel.glsl"
#include "raster/parallel/rays_along.glsl"

// Every lumel i looks along K global directions d and gathers the light of the first surface,
// [TN11] Eq. (2) and Figure 5:
//
//     H_i += Σ_k  4 B_j max(n_i · d_k, 0),        j the lumel seen from i along d_k;
//
// for the sky, 4π L. The map's fragments name lumels, so emitted and reflected light are gathered
// separately in one pass.
//
// Stochastic layers: looks up (2 neighbours + 1)² pixels, rejects surfaces below the receiver's
// plane, and takes the nearest of the rest: LookupTest::paper. With slabs, this is done in the
// receiver's slab; the first surface beyond it is known exactly by one lookup.
//
// On concave ground the surface beside a point x rises above the plane of x, but does not lie on
// the ray from x. LookupTest::planes therefore takes each sample s as the plane that its triangle
// lies in, nearness z(q) = z_s + g_s·(q - q_s) at pixel position q, and asks for z at the ray of x:
//
//     s occludes x    if  s lies above the plane of x,  and  z(q_x) > z_x,
//
// and the nearest z(q_x) counts. Where both lie on a surface with z'' = c, s is c/2 |q_s - q_x|²
// above the plane of x, and x as far above that of s: one of the two always rejects s. Where z''
// changes its sign between them, or on facets, this is not so, but then s shows its back: a ray
// from one side of a surface that is closed, or has no overhangs, meets it on the same side first,
// so the other side of the receiver's instance is rejected.
//
// A list has every surface on the ray through a pixel's centre. The receiving point is moved to
// where such a ray hits the lumel (first_met.glsl), so the result is exact, as with peeled layers:
// they approach the lumel one by one, and the last one above it is kept.
//
// With coloured glass, directions take the colour channels in turn.

layout(local_size_x = kGroup) in;
layout(constant_id = 0) const uint kLayers = kStochasticLayers;
layout(push_constant, scalar) uniform Params { GatherParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(scalar) readonly buffer Directions { GlobalDirection directions[]; };
uniform usampler2D illumination_map;
layout(scalar) readonly buffer Heads { uint heads[]; };
layout(scalar) readonly buffer Fragments { Fragment fragments[]; };
layout(scalar) readonly buffer LumelOf { uint lumel_of[]; };  // by side and texel
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) readonly buffer Source { vec3 source[]; };
layout(scalar) buffer Direct { vec3 direct[]; };  // [2][N] sums
layout(scalar) buffer Indirect { vec3 indirect[]; };  // [2][N] sums
layout(scalar) buffer Kept { uint kept[]; };  // [K][N] peeled: surface seen so far
layout(scalar) buffer News { uint news; };  // peeled: 1: a lumel's surface has changed
layout(scalar) buffer SeenLightOf { SeenLight seen_light_of[]; };

const float kPi = 3.14159265;
// Surfaces higher than this above the plane are not the receiver itself [pixel widths].
const float kAbovePlane = 0.02;

// Bits of infinity: the sky is behind all planes.
const uint kSkyNearness = 0x7f800000u;

// A piece of this width has a ray for any position of the pixel grid [pixels].
const float kWide = 2.0;

// Σ cosθ of 32 directions over the sphere; P is assumed exact before.
const float kUsual = 8.0;

struct Seen {
    uint surface;  // as in a Fragment; 0: the sky
    float weight;  // 0: unknown
};

// A receiving point in a view.
struct InView {
    vec2 at;         // [pixels]
    float nearness;
    // Heights above the receiver's plane, per pixel and per nearness [pixel widths].
    vec2 per_pixel;
    float per_nearness;
    float widths;      // pixel widths per nearness
};

InView in_view(ParallelView view, LumelPoint point)
{
    const float pixels_per_metre = length(view.right), nearness_per_metre = length(view.toward);
    const vec3 normal = normalize(point.facing);
    return InView(place_in(view, point.position), nearness_in(view, point.position),
                  vec2(dot(normal, view.right), dot(normal, view.up)) / pixels_per_metre,
                  dot(normal, view.toward) * pixels_per_metre /
                      (nearness_per_metre * nearness_per_metre),
                  pixels_per_metre / nearness_per_metre);
}

// Distance within which a sample can be ground beside the point [pixel widths].
float beside()
{
    return 2.0 * float(p.neighbours + 1u);
}

// True for the other side of the receiver's own instance.
bool is_own_other_side(uint surface, Lumel receiver)
{
    if (surface == kAbsorbing)
        return false;
    const uint side = (surface - 1u) & 1u;
    const uint lit = lumel_of[surface - 1u];
    const uint j = lit != kNoLumel ? lit : lumel_of[(surface - 1u) ^ 1u];
    const uint own = (receiver.flags & kLumelBack) != 0u ? 1u : 0u;
    return side != own && j != kNoLumel && lumels[j].instance == receiver.instance;
}

// Result of a lookup: a sample's nearness and that of its plane on the point's own ray.
struct Lookup {
    uint surface;   // 0: nothing
    float there;    // nearness of the sample
    float on_ray;   // nearness of its plane on the ray through the point
    float above;    // height of the sample above the receiver's plane [pixel widths]
    float ahead;    // distance from the point to the sample's plane, if ahead [pixel widths]
};

Lookup look_up(InView point, ivec2 corner, ivec2 pixel)
{
    const uvec4 found = texelFetch(illumination_map, corner + pixel, 0);
    const vec2 offset = vec2(pixel) + 0.5 - point.at, slopes = uintBitsToFloat(found.zw);
    Lookup lookup;
    lookup.surface = found.x;
    lookup.there = uintBitsToFloat(found.y);
    lookup.on_ray = lookup.there - dot(slopes, offset);
    lookup.above = dot(point.per_pixel, offset) +
                   point.per_nearness * (lookup.there - point.nearness);
    const vec2 steepness = slopes * point.widths;
    lookup.ahead = (lookup.on_ray - point.nearness) * point.widths *
                   inversesqrt(1.0 + dot(steepness, steepness));
    return lookup;
}

bool is_occluder(Lookup lookup, InView point, Lumel receiver)
{
    if (lookup.surface == 0u || lookup.above <= kAbovePlane)
        return false;
    if (p.by_planes == 0u)
        return lookup.there > point.nearness;
    return lookup.ahead > kAbovePlane &&
           !(lookup.ahead < beside() && is_own_other_side(lookup.surface, receiver));
}

// The nearest surface within `reach` pixels of the point, or `before`.
uvec2 nearest_around(Lumel receiver, InView point, uint tile, int reach, uvec2 before)
{
    const ivec2 corner = ivec2(tile_corner(p.tiling, tile));
    const int last = int(p.tiling.side) - 1;
    uvec2 nearest = before;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            const ivec2 pixel = clamp(ivec2(floor(point.at)) + ivec2(x, y), ivec2(0), ivec2(last));
            const Lookup lookup = look_up(point, corner, pixel);
            const float nearness = p.by_planes != 0u ? lookup.on_ray : lookup.there;
            if (nearness < uintBitsToFloat(nearest.y) && is_occluder(lookup, point, receiver))
                nearest = uvec2(lookup.surface, floatBitsToUint(nearness));
        }
    return nearest;
}

Seen see_by_chance(ParallelView view, uint k, Lumel lumel, LumelPoint receiver)
{
    const InView point = in_view(view, receiver);
    const uint slab = min(uint(max(point.nearness, 0.0) * float(p.slabs)), p.slabs - 1u);
    const uint tile = k * p.maps + slab;
    uvec2 nearest = uvec2(0u, kSkyNearness);
    nearest = nearest_around(lumel, point, tile, int(p.neighbours), nearest);
    if (slab + 1u < p.slabs)
        nearest = nearest_around(lumel, point, tile + p.slabs, 0, nearest);
    return Seen(nearest.x, 1.0);
}

uint nearest_listed(PieceInView piece, RayMet ray, uint tile)
{
    const uint side = p.tiling.side;
    uint next = heads[(tile * side + uint(ray.pixel.y)) * side + uint(ray.pixel.x)];
    uint surface = 0u;
    float first = 2.0;
    while (next != kEndOfList) {
        const Fragment fragment = fragments[next];
        const bool nearer = fragment.nearness < first ||
                            (fragment.nearness == first && fragment.surface < surface);
        if (nearer && !is_first(piece, ray, fragment.nearness)) {
            first = fragment.nearness;
            surface = fragment.surface;
        }
        next = fragment.next;
    }
    return surface;
}

uint nearest_peeled(PieceInView piece, RayMet ray, uint tile, uint i)
{
    const uint at = tile * p.count + i;
    if (p.keep == 0u)
        return kept[at];
    const ivec2 place = ivec2(tile_corner(p.tiling, tile)) + ivec2(ray.pixel);
    const uvec2 fragment = texelFetch(illumination_map, place, 0).xy;
    if (fragment.x != 0u && !is_first(piece, ray, uintBitsToFloat(fragment.y))) {
        kept[at] = fragment.x;
        atomicMax(news, 1u);
    } else if (p.layer == 0u)
        kept[at] = 0u;
    return fragment.x;
}

// A ray that hits the point's piece. For a thin piece any ray represents those that hit it; their
// mean number over all grid positions is `mean`.
bool choose_ray(ParallelView view, PieceInView piece, LumelPoint point, uint random, out RayMet ray)
{
    const RaysAlong rays = rays_along(view, p.tiling, pieces[point.piece], piece);
    if (rays.width > kWide) {
        const vec2 place = place_in(view, point.position), size = vec2(p.tiling.side);
        const bool found = find_ray(piece, place, size, ray);
        ray.chance = 1.0;
        return found;
    }
    const float count = count_rays(rays, p.tiling);
    if (count == 0.0)
        return false;
    ray = RayMet(nth_ray(rays, p.tiling, floor(unit_float(random) * count)), rays.mean / count);
    return true;
}

Seen see_exactly(ParallelView view, uint k, LumelPoint point, uint i)
{
    const PieceInView piece = piece_along(view, pieces[point.piece]);
    RayMet ray;
    if (!choose_ray(view, piece, point, hash(i ^ hash(p.first_point + k)), ray))
        return Seen(0u, 0.0);
    return Seen(kLayers == kListedLayers ? nearest_listed(piece, ray, k)
                                         : nearest_peeled(piece, ray, k, i),
                1.0 / ray.chance);
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    vec3 of_emission = vec3(0.0), of_source = vec3(0.0);
    SeenLight light = seen_light_of[i];
    for (uint k = 0u; k < p.views; ++k) {
        const GlobalDirection direction = directions[p.first_view + k];
        const LumelPoint point =
            receiving_point(lumel, i, p.first_point + k, p.seed, p.centre != 0u);
        const float cosine = dot(point.normal, direction.toward);
        if (cosine <= 0.0 || dot(point.facing, direction.toward) <= 0.0)
            continue;
        const ParallelView view = views[p.first_view + k];
        const Seen seen = kLayers == kStochasticLayers ? see_by_chance(view, k, lumel, point)
                                                       : see_exactly(view, k, point, i);
        if (p.keep != 0u)
            continue;
        const vec3 weight = 4.0 * cosine * seen.weight * carried_in_turn(view.channel);
        light.sought += cosine;
        light.found += cosine * seen.weight;
        if (seen.surface == 0u) {
            of_emission += weight * kPi * direction.sky;
            continue;
        }
        if (seen.surface == kAbsorbing)
            continue;
        const uint j = lumel_of[seen.surface - 1u];
        if (j == kNoLumel)
            continue;
        if (p.with_emission != 0u)
            of_emission += weight * emission[j];
        if (p.with_source != 0u)
            of_source += weight * source[j];
    }
    if (p.keep != 0u)
        return;
    seen_light_of[i] = light;
    const float correction = (light.sought + kUsual) / (light.found + kUsual);
    const uint at = p.half_index * p.count + i;
    direct[at] += correction * of_emission;
    indirect[at] += correction * of_source;
}
