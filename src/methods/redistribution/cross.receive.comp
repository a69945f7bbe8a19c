#version 460
#include "methods/redistribution/cross.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "raster/eyes/hemicube.glsl"
#include "raster/near/near_pairs.glsl"
#include "raster/near/near_factor.glsl"
#include "solve/shooting/receiver.glsl"

// Effect of movable patches j on static lumels i, [Hoef13] Eq. (3.3.1):
//
//     ΔH_i = Σ_j F_ij (B_j - P(C, j, i))
//
// They send their own light, R_p(M, C), and occlude light that would pass through them, R_x(C, C):
// P is the mean of the light behind j hit by rays from i through the lumels of j, from the hemicube
// on the back of j. F_ij of close pairs is the near field's. Backs of patches of open meshes
// occlude light as well; they send none.
//
// V_ij is that of progressive.receive.comp, of receiving points of the lumel: a lumel that is half
// behind a lamp is half seen. There the many patches of C average it; M has few, so each takes
// several points.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { CrossReceiveParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Shots { PatchShot shots[]; };
layout(scalar) readonly buffer Sent { vec3 shot[]; };
#include "methods/redistribution/cross.behind.glsl"
layout(scalar) buffer Fresh { vec3 fresh[]; };

// Rays through a lumel, along each of its sides, per radian that it subtends at the receiver; and
// the maximum.
const float kRaysPerRadian = 4.0;
const float kMaxRays = 3.0;

// Added to r² in the weight of a ray, relative to the lumel's area: finite where they touch.
const float kTouching = 0.01;
// Minimum distance for angles [m].
const float kMinDistance = 1e-6;

// Receiving points for V_ij: a lamp near a surface hides parts of its lumels.
const uint kVisibilityPoints = 4u;

// Light in that direction, interpolated between two levels.
vec3 behind(uint k, float level, vec3 direction)
{
    const uint fine = uint(level);
    const float part = level - float(fine);
    const vec3 light = level_behind(p.back, k, fine, direction);
    return part > 0.0 ? mix(light, level_behind(p.back, k, fine + 1u, direction), part) : light;
}

// Light behind a patch along the ray from x through y, for a bundle of width `width` at y [m]. The
// depth in the ray's own direction predicts where it ends; the back eye looks up that point
// [Hoef13] 4.5.2, Reproject.
vec3 light_along(uint k, mat3 frame, vec3 x, vec3 y, float width)
{
    const vec3 ray = y - x;
    const float r = length(ray);
    const vec3 direction = ray * frame / r;
    if (direction.z <= 0.0)
        return vec3(0.0);
    const float inverse = inverse_behind(p.back, k, direction);
    if (inverse <= 0.0)
        return vec3(0.0);
    const vec3 toward = (y - eyes[k].position) * frame + direction / inverse;
    // Width of its end, seen from the back eye [rad], in pixels.
    const float pixels = width * (inverse + 1.0 / r) * 0.5 * float(p.back.side);
    const float level = clamp(log2(max(pixels, 1.0)), 0.0, float(kBackLevels - 1u));
    return toward.z > 0.0 ? behind(k, level, toward) : vec3(0.0);
}

// P(C, j, i) for the lumel m of the patch: more rays where it is close, each weighted by the light
// that would pass along it. 0 where it is not needed.
vec3 light_behind(uint k, Receiver r, Lumel m, bool is_asked)
{
    const Eye eye = eyes[k];
    const mat3 frame = mat3(eye.tangent, -eye.bitangent, -eye.normal);
    const float wide = m.size / max(distance(r.x, m.position), kMinDistance);  // [rad]
    const uint side = uint(clamp(ceil(wide * kRaysPerRadian), 1.0, kMaxRays));
    const uint rays = is_asked ? side * side : 0u;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint q = 0u; q < rays; ++q) {
        const vec2 at = (vec2(q % side, q / side) + 0.5) / float(side);
        const vec3 y = rays == 1u ? m.position : point_on(m, at.x, at.y).position;
        const vec3 d = y - r.x;
        const float r2 = dot(d, d) + kTouching * m.area;
        const float weight = max(dot(d, r.normal), 0.0) * abs(dot(d, eye.normal)) / (r2 * r2);
        if (weight > 0.0)
            sum += weight * light_along(k, frame, r.x, y, m.size / float(side));
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : vec3(0.0);
}

// V_ij: share of the lumel's receiving points that the patch's eye sees.
float visibility(Lumel lumel, uint i, uint k)
{
    uint seen = 0u;
    for (uint n = 0u; n < kVisibilityPoints; ++n) {
        const LumelPoint x =
            receiving_point(lumel, i, kVisibilityPoints * shots[k].number + n, 0u, false);
        seen += is_seen(receiver_at(x, lumel, i), eyes[k], k, p.views) ? 1u : 0u;
    }
    return float(seen) / float(kVisibilityPoints);
}

// F_ij for the lumel j of patch k, given V_ij.
float factor_of(Receiver r, uint k, uint j, float visible)
{
    const Lumel from = lumels[j];
    const bool is_back = shots[k].facing < 0.0;
    if (!is_back && is_near(r.centre, r.size, from.position, from.size, p.near_radius))
        return near_factor(r.lumel, j);
    if (visible == 0.0)
        return 0.0;
    // Backs have no near field: the disc of Eq. (2.2.7) keeps close ones finite.
    const float disc = is_back ? from.area / kPi : 0.0;
    return visible * from.area / kPi *
           point_factor(r.x - from.position, shots[k].facing * from.normal, r.normal, disc);
}

// Effect of all lumels of patch k.
vec3 crossing_light(Receiver r, uint k)
{
    const PatchShot s = shots[k];
    const float visible = visibility(lumels[r.lumel], r.lumel, k);
    vec3 sum = vec3(0.0);
    for (uint j = s.first; j < s.first + s.count; ++j) {
        const float factor = factor_of(r, k, j, visible);
        const vec3 sent = s.facing < 0.0 ? vec3(0.0) : shot[j];
        sum += factor * (sent - light_behind(k, r, lumels[j], factor > 0.0));
    }
    return sum;
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & (kLumelBuried | kLumelMoving)) != 0u)
        return;
    // Rays from one point, so that the light occluded by adjacent patches is consistent; V is from
    // several.
    const Receiver r =
        receiver_at(LumelPoint(lumel.position, lumel.normal, lumel.normal, 0u), lumel, i);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.shots; ++k)
        if (shots[k].count > 0u)
            sum += crossing_light(r, k);
    fresh[i] += sum;
}
