#version 460
#include "solve/shooting/shooters.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "solve/shooting/power_pyramid.glsl"
#include "raster/world/lumel.glsl"
#include "solve/shooting/shooter.glsl"
#include "solve/shooting/merged_texels.glsl"
#include "raster/world/channel.glsl"

// Draws the shooters of one batch: p(y) ∝ power ([BSS05] section 4.1, [BJ04] section 3.1), the
// point y uniform on lumel j, the hemicube rotated at random about the normal.
//
// Merged ([BSS05] section 5), the texels m of a square that lie on j's patch shoot as one of area A
// = Σ A_m and radiosity Σ X_m A_m / A, drawn with p = Σ p_m. Its position is their common centre,
// or, if points are spread over texels, a point on the texel drawn.
//
// With coloured glass, visibility differs between channels: each shooter takes one channel, with
// three times its power.

layout(local_size_x = kSelectGroup) in;
layout(push_constant, scalar) uniform Params { SelectParams p; };
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) readonly buffer Source { vec3 source[]; };
layout(scalar) readonly buffer EmissionPower { float emission_power[]; };
layout(scalar) readonly buffer SourcePower { float source_power[]; };
layout(scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(scalar) writeonly buffer Shots { Shot shots[]; };

struct Merged {
    vec3 power;    // Σ X_m A_m
    float area;    // Σ A_m
    float weight;  // Σ of selection weights
};

Merged merged_with(uint j)
{
    const uint count = p.pyramid.count[0];
    const uint last = last_of_square(j, p.merge, count);
    Merged sum = Merged(vec3(0.0), 0.0, 0.0);
    for (uint m = first_of_square(j, p.merge); m <= last; ++m)
        if (shoot_as_one(lumels[j], lumels[m], p.merge, p.width)) {
            sum.power += source[m] * lumels[m].area;
            sum.area += lumels[m].area;
            sum.weight += source_power[p.pyramid.first[0] + m];
        }
    return sum;
}

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.count)
        return;
    const bool emits = k < p.emission_count;
    const uint index = emits ? p.emission_index + k : p.source_index + k - p.emission_count;
    // Channels take turns, so that each uses a complete sequence.
    const uint point = p.channels != 0u ? index / kChannels : index;
    const vec3 u = draw_point(point, emits ? 0u : 1u, p.seed, p.random != 0u);

    Drawn drawn;
    if (emits)
        DRAW_FROM(emission_power, p.pyramid, u.x, drawn)
    else
        DRAW_FROM(source_power, p.pyramid, u.x, drawn)

    const uint j = drawn.lumel;
    const Lumel lumel = lumels[j];
    const float area = lumel.area;
    LumelPoint y = point_on(lumel, u.y, u.z);
    if (p.centre != 0u) {
        const MergedPlace centre =
            merged_place(j, emits ? 0u : p.merge, p.pyramid.count[0], p.width);
        y.position = centre.position;
        y.normal = centre.normal;
    }
    const uint channel = channel_in_turn(index, p.channels != 0u);
    eyes[k] = make_eye(y.position, y.normal, hash(hash(index ^ hash(p.seed)) + (emits ? 1u : 2u)),
                       channel);

    Merged sent = Merged((emits ? emission[j] : source[j]) * area, area, 1.0);
    float probability = drawn.probability;
    if (p.merge > 0u && !emits && probability > 0.0) {
        sent = merged_with(j);
        probability *= sent.weight / source_power[p.pyramid.first[0] + j];
    }
    const float scale = probability > 0.0 ? 1.0 / (kPi * probability) : 0.0;
    shots[k] = Shot(sent.power * carried_in_turn(channel) * scale, lumel.position, lumel.size,
                    p.disc != 0u ? sent.area / kPi : 0.0, j);
}
