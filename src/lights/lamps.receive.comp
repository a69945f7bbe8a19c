#version 460
#include "lights/lamps.shared.h"
#include "atlas/lumel.shared.h"
#include "core/hash.glsl"

// Every lumel takes the light of K points of lamps:
//
//     H += Σ_k  share_k · I(ω) / r² · V cosθ · window(r),
//
// I the lamp's intensity towards the lumel. A ball of even luminance L and radius R has I = π R² L;
// a point y drawn evenly from its surface stands for  4 I max(n_y·ω, 0).

layout(local_size_x = kLampGroup) in;
layout(push_constant, scalar) uniform Params { LampReceiveParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Eyes { Eye eyes[]; };  // of this batch
layout(binding = 3, scalar) readonly buffer Shots { LampShot shots[]; };  // of all
layout(binding = 4, scalar) readonly buffer Lamps { Lamp lamps[]; };
layout(binding = 5, scalar) readonly buffer Profiles { float candela[]; };
layout(binding = 6) uniform sampler2D views;
layout(binding = 7, scalar) buffer Irradiance { vec3 irradiance[]; };

#include "world/lumel.glsl"
#include "world/receiving_point.glsl"
#include "visibility/sees.glsl"

const float kPi = 3.14159265;

float profile_value(uint profile, uint azimuth, uint polar)
{
    return candela[(profile * p.azimuth_steps + azimuth % p.azimuth_steps) * (p.polar_steps + 1u) +
                   polar];
}

// Bilinear, as Photometry says.
float profile_towards(Lamp lamp, vec3 way)
{
    const float polar =
        acos(clamp(-dot(way, lamp.z), -1.0, 1.0)) * (float(p.polar_steps) / kPi);
    const float turn = atan(dot(way, lamp.y), dot(way, lamp.x)) / (2.0 * kPi);
    const float azimuth = fract(turn) * float(p.azimuth_steps);
    const uint row = min(uint(polar), p.polar_steps - 1u), column = uint(azimuth);
    const vec2 part = vec2(polar - float(row), azimuth - float(column));
    const float low = mix(profile_value(lamp.profile, column, row),
                          profile_value(lamp.profile, column, row + 1u), part.x);
    const float high = mix(profile_value(lamp.profile, column + 1u, row),
                           profile_value(lamp.profile, column + 1u, row + 1u), part.x);
    return mix(low, high, part.y);
}

vec3 intensity_towards(Lamp lamp, vec3 way)
{
    const float cone = clamp(-dot(way, lamp.z) * lamp.cone_scale + lamp.cone_offset, 0.0, 1.0);
    const float profile = lamp.profile == kNoProfile ? 1.0 : profile_towards(lamp, way);
    return lamp.intensity * (cone * cone * profile);
}

float range_window(Lamp lamp, float squared)
{
    if (lamp.range <= 0.0)
        return 1.0;
    const float part = squared / (lamp.range * lamp.range);
    return clamp(1.0 - part * part, 0.0, 1.0);
}

vec3 receive(LumelPoint point, uint k)
{
    const Eye eye = eyes[k];
    const vec3 d = point.position - eye.position;
    const float squared = dot(d, d), away = dot(d, eye.normal), facing = -dot(d, point.normal);
    if (away <= 0.0 || facing <= 0.0 || dot(d, point.facing) >= 0.0)
        return vec3(0.0);
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    if (!sees(p.views, k, d * frame, point.facing * frame))
        return vec3(0.0);
    const LampShot shot = shots[p.first_shot + k];
    const Lamp lamp = lamps[shot.lamp];
    const float distance_ = sqrt(squared);
    const float ball = shot.ball != 0u ? 4.0 * away / distance_ : 1.0;
    return intensity_towards(lamp, d / distance_) *
           (shot.share * ball * range_window(lamp, squared) * facing / (squared * distance_));
}

void main()
{
    const uint i = p.first + gl_GlobalInvocationID.x;
    if (i >= p.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    const LumelPoint point = receiving_point(lumel, i, p.iteration, p.seed, p.centre != 0u);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.shots; ++k)
        sum += receive(point, k);
    irradiance[i] += sum;
}
