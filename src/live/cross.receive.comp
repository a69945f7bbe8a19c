#version 460
#include "live/cross.shared.h"
#include "atlas/lumel.shared.h"
#include "shooting/radiosity.glsl"

// What the patches j of what moves do to the lumels i of what stays [Hoef13] Eq. (3.3.1):
//
//     ΔH_i = Σ_j F_ij (B_j - P(C, j, i))
//
// They send their own light, R_p(M, C), and hide the light that would pass through them,
// R_x(C, C): P is the mean of the light behind j that rays from i through the lumels of j meet, as
// the hemicube on the back of j shows it. F_ij of close pairs is the near field's. Where a mesh is
// open, the backs of its patches hide light as well; they send none.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { CrossReceiveParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(binding = 3, scalar) readonly buffer Shots { PatchShot shots[]; };
layout(binding = 4) uniform sampler2D views;
layout(binding = 5, scalar) readonly buffer Sent { vec3 shot[]; };
layout(binding = 6, scalar) readonly buffer Back { BackPixel back[]; };
layout(binding = 7, scalar) readonly buffer NearFirst { uint near_first[]; };  // [N + 1]
layout(binding = 8, scalar) readonly buffer NearColumn { uint near_column[]; };
layout(binding = 9, scalar) readonly buffer NearFactor { float near_factors[]; };
layout(binding = 10, scalar) buffer Fresh { vec3 fresh[]; };

#include "world/lumel.glsl"
#include "visibility/sees.glsl"
#include "visibility/hemicube.glsl"
#include "live/cross.back.glsl"
#include "nearfield/near_pairs.glsl"
#include "nearfield/near_factor.glsl"
#include "shooting/receiver.glsl"

// Rays through a lumel, along each of its sides, for each radian that it measures from the
// receiver; and at most.
const float kRaysPerRadian = 16.0;
const float kMostRays = 6.0;

// r² in the weight of a ray is larger by this part of the lumel's area: finite where they touch.
const float kTouching = 0.01;
// Distances at which angles are taken are no less [m].
const float kLeastDistance = 1e-6;

// The pixel of a back hemicube's level in direction `direction` (t, b, n of the back eye; n ≥ 0).
BackPixel behind(uint k, uint level, vec3 direction)
{
    const uint side = back_side(p.back, level);
    const ViewPoint f = project_to_hemicube(EyeViewLayout(side, 1u, 1.0), direction);
    return back[back_pixel(p.back, k, level, uvec2(face_corner(side, f) + f.pixel))];
}

// Light that a ray from x through the point y of a patch meets behind it, if it stands for a bundle
// `width` wide at y [m]. The depth in the ray's own direction guesses where it ends; the back eye
// looks there [Hoef13] 4.5.2, Reproject.
vec3 light_along(uint k, mat3 frame, vec3 x, vec3 y, float width)
{
    const vec3 ray = y - x;
    const float r = length(ray);
    const vec3 direction = ray * frame / r;
    if (direction.z <= 0.0)
        return vec3(0.0);
    const float inverse = behind(k, 0u, direction).inverse;
    if (inverse <= 0.0)
        return vec3(0.0);
    const vec3 toward = (y - eyes[k].position) * frame + direction / inverse;
    // As wide is its end as seen from the back eye [rad], and in pixels.
    const float pixels = width * (inverse + 1.0 / r) * 0.5 * float(p.back.side);
    const uint level = uint(clamp(log2(max(pixels, 1.0)) + 0.5, 0.0, float(kBackLevels - 1u)));
    return toward.z > 0.0 ? behind(k, level, toward).shot : vec3(0.0);
}

// P(C, j, i) for the lumel m of the patch: more rays where it is close, each weighted by the light
// that would pass along it. 0 where it is not needed.
vec3 light_behind(uint k, Receiver r, Lumel m, bool is_asked)
{
    const Eye eye = eyes[k];
    const mat3 frame = mat3(eye.tangent, -eye.bitangent, -eye.normal);
    const float wide = m.size / max(distance(r.x, m.position), kLeastDistance);  // [rad]
    const uint side = uint(clamp(ceil(wide * kRaysPerRadian), 1.0, kMostRays));
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

// F_ij for the lumel j of patch k, of which the receiver sees the patch's eye or not.
float factor_of(Receiver r, uint k, uint j, bool is_eye_seen)
{
    const Lumel from = lumels[j];
    const bool is_back = shots[k].side_ < 0.0;
    if (!is_back && is_near(r.centre, r.size, from.position, from.size, p.near_radius))
        return near_factor(r.lumel, j);
    if (!is_eye_seen)
        return 0.0;
    // Backs have no near field: the disc of Eq. (2.2.7) keeps close ones finite.
    const float disc = is_back ? from.area / kPi : 0.0;
    return from.area / kPi *
           point_factor(r.x - from.position, shots[k].side_ * from.normal, r.normal, disc);
}

// Of all lumels of patch k.
vec3 crossing_light(Receiver r, uint k)
{
    const PatchShot s = shots[k];
    const bool is_eye_seen = is_seen(r, k, p.views);
    vec3 sum = vec3(0.0);
    for (uint j = s.first; j < s.first + s.count; ++j) {
        const float factor = factor_of(r, k, j, is_eye_seen);
        const vec3 sent = s.side_ < 0.0 ? vec3(0.0) : shot[j];
        sum += factor * (sent - light_behind(k, r, lumels[j], factor > 0.0));
    }
    return sum;
}

void main()
{
    const uint i = p.first + gl_GlobalInvocationID.x;
    if (i >= p.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & (kLumelBuried | kLumelMoving)) != 0u)
        return;
    // From one point, so that what the patches hide fits together.
    const Receiver r =
        receiver_at(LumelPoint(lumel.position, lumel.normal, lumel.normal, 0u), lumel, i);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.shots; ++k)
        if (shots[k].count > 0u)
            sum += crossing_light(r, k);
    fresh[i] += sum;
}
