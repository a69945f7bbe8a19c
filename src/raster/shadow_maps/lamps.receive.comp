#version 460
#include "raster/shadow_maps/lamps.shared.h"
#include "scene/values/photometry.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/world/channel.glsl"
#include "raster/eyes/pixels.glsl"
#include "raster/world/first_met.glsl"
#include "raster/eyes/piece_from.glsl"

// Every lumel receives light of K eyes at a lamp:
//
//     H = Σ_k  share · I(ω) / r² · V cosθ · window(r),
//
// with the lamp's intensity I towards the lumel. A ball of uniform luminance L and radius R has I =
// π R² L; a uniformly sampled point y of its surface represents  4 I max(n_y·ω, 0).
//
// V is summed as described in light_sums.shared.h. Unoccluded light varies much over a lumel, so it
// is sampled at more points than V. With coloured glass V depends on the channel, and each eye has
// one.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { LampReceiveParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Lamps { Lamp lamps[]; };
layout(scalar) readonly buffer Profiles { float candela[]; };
layout(scalar) buffer Sums { LightSums sums[]; };

const float kPi = 3.14159265;

// From here to range_window(): duplicates scene/values/photometry.cpp.

float profile_value(uint profile, uint azimuth, uint polar)
{
    return candela[(profile * kAzimuthSteps + azimuth % kAzimuthSteps) * (kPolarSteps + 1u) +
                   polar];
}

// Bilinear interpolation of a Photometry.
float profile_towards(Lamp lamp, vec3 direction)
{
    const float polar =
        acos(clamp(-dot(direction, lamp.z), -1.0, 1.0)) * (float(kPolarSteps) / kPi);
    const float turn = atan(dot(direction, lamp.y), dot(direction, lamp.x)) / (2.0 * kPi);
    const float azimuth = fract(turn) * float(kAzimuthSteps);
    const uint row = min(uint(polar), kPolarSteps - 1u), column = uint(azimuth);
    const vec2 part = vec2(polar - float(row), azimuth - float(column));
    const float low = mix(profile_value(lamp.profile, column, row),
                          profile_value(lamp.profile, column, row + 1u), part.x);
    const float high = mix(profile_value(lamp.profile, column + 1u, row),
                           profile_value(lamp.profile, column + 1u, row + 1u), part.x);
    return mix(low, high, part.y);
}

vec3 intensity_towards(Lamp lamp, vec3 direction)
{
    const float cone =
        clamp(-dot(direction, lamp.z) * lamp.cone_scale + lamp.cone_offset, 0.0, 1.0);
    const float profile = lamp.profile == kNoProfile ? 1.0 : profile_towards(lamp, direction);
    return lamp.intensity * (cone * cone * profile);
}

float range_window(Lamp lamp, float squared)
{
    if (lamp.range <= 0.0)
        return 1.0;
    const float part = squared / (lamp.range * lamp.range);
    return clamp(1.0 - part * part, 0.0, 1.0);
}

// A uniform ball wholly above the horizon has the irradiance of its centre.
bool is_whole_ball(Lamp lamp, LumelPoint point)
{
    return lamp.radius > 0.0 && lamp.cone_scale == 0.0 && lamp.profile == kNoProfile &&
           lamp.range <= 0.0 && dot(lamp.position - point.position, point.normal) > lamp.radius &&
           dot(lamp.position - point.position, normalize(point.facing)) > lamp.radius;
}

vec3 light_of_centre(Lamp lamp, LumelPoint point)
{
    const vec3 d = lamp.position - point.position;
    const float squared = dot(d, d);
    return lamp.intensity * (lamp.share * dot(d, point.normal) / (squared * sqrt(squared)));
}

// Unoccluded light of an eye at a point; 0 if either faces away.
vec3 open_light(Lamp lamp, Eye eye, LumelPoint point)
{
    const vec3 d = point.position - eye.position;
    const float squared = dot(d, d), away = dot(d, eye.normal), facing = -dot(d, point.normal);
    if (away <= 0.0 || facing <= 0.0 || dot(d, point.facing) >= 0.0)
        return vec3(0.0);
    const float reach = sqrt(squared);
    const float ball = lamp.radius > 0.0 ? 4.0 * away / reach : 1.0;
    return intensity_towards(lamp, d / reach) *
           (lamp.share * ball * range_window(lamp, squared) * facing / (squared * reach));
}

// Finds a ray of eye k's hemicube that hits the piece of the point. `seen`: true if it is
// unoccluded.
bool ask_view(Eye eye, uint k, LumelPoint point, out RayMet ray, out bool seen)
{
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    const ViewPoint f = project(p.views, (point.position - eye.position) * frame);
    const PieceInView piece = piece_from(p.views, f, eye.position, frame, pieces[point.piece]);
    const float side = float(p.views.side);
    const bool found = find_ray(piece, f.at, vec2(side, f.front ? side : 0.5 * side), ray);
    seen = found && is_first(piece, ray, stored_depth(p.views, k, f, ray.pixel));
    return found;
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    const Lamp lamp = lamps[p.lamp];
    LightSums sum = sums[i];
    for (uint k = 0u; k < p.eyes; ++k) {
        const Eye eye = eyes[k];
        // Halves and channels use the same points: each point is in view of one of them.
        const uint index = (p.first_eye + k) / lamp.eyes_per_look * kOpenPoints;
        const vec3 channels = carried(eye.channel);
        vec3 here = vec3(0.0);
        LumelPoint point;
        for (uint n = 0u; n < kOpenPoints; ++n) {
            point = receiving_point(lumel, i, index + n, p.seed, p.centre != 0u);
            here = channels * open_light(lamp, eye, point);
            sum.open += channels *
                        (is_whole_ball(lamp, point) ? light_of_centre(lamp, point) : here) /
                        float(kOpenPoints);
        }
        if (here == vec3(0.0))
            continue;
        RayMet ray;
        bool seen;
        if (!ask_view(eye, k, point, ray, seen))
            continue;
        sum.known += here / ray.chance;
        if (seen)
            sum.arrived += here / ray.chance;
    }
    sums[i] = sum;
}
