#version 460
#include "solve/glossy.shared.h"
#include "core/hash.glsl"
#include "shooting/radiosity.glsl"
#include "shooting/power_pyramid.glsl"
#include "world/lumel.glsl"
#include "lobes/phong.glsl"
#include "shooting/shooter.glsl"
#include "visibility/channel.glsl"

// Draws the shooters of one iteration in proportion to their power ([BSS05] section 4.1) and
// prepares what they send ([BSS05] Eq. (7)): their emission and diffuse light whole, and lobes of
// the earlier shooters that lit them.

layout(local_size_x = kGlossySelectGroup) in;
layout(push_constant, scalar) uniform Params { GlossySelectParams p; };
layout(scalar) readonly buffer Glosses { Gloss gloss[]; };
layout(scalar) readonly buffer Diffuse { vec3 diffuse[]; };  // [N] exitance
layout(scalar) readonly buffer Last { vec3 last[]; };  // [K][N] I of each shooter
layout(scalar) readonly buffer Power { float power[]; };
layout(scalar) readonly buffer Before { Eye before[]; };  // [K] earlier shooters
layout(scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(scalar) writeonly buffer Shots { GlossyShot shots[]; };
layout(scalar) writeonly buffer Lobes { GlossyLobe lobes_sent[]; };  // [K][most]

// What shooter k's light gives the lobe: the luminance of ρ_s I_k a(ω_k).
float lobe_power(uint j, uint k, LumelPoint y)
{
    const vec3 toward = normalize(before[k].position - y.position);
    return luminance(gloss[j].specular * last[k * p.count + j]) *
           phong_albedo(dot(toward, y.normal), gloss[j].shininess);
}

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.shots)
        return;
    const uint index = p.index + k;
    // Iterations must be independent of each other: each has a sequence of its own.
    const vec3 u = draw_point(k, hash(p.index), p.seed, p.random != 0u);
    Drawn drawn;
    DRAW_FROM(power, p.pyramid, u.x, drawn)

    const uint j = drawn.lumel;
    const Lumel lumel = lumels[j];
    const Gloss g = gloss[j];
    const LumelPoint y = point_on(lumel, u.y, u.z);
    const uint random = hash(hash(index ^ hash(p.seed)) + 1u);
    const uint channel = channel_in_turn(index, p.channels != 0u);
    eyes[k] = make_eye(y.position, y.normal, random, channel);

    float lobes = 0.0;
    for (uint e = 0u; e < p.before; ++e)
        lobes += lobe_power(j, e, y);
    const vec3 scale =
        drawn.probability > 0.0
            ? carried_in_turn(channel) * (lumel.area / (drawn.probability * float(p.shots)))
            : vec3(0.0);
    GlossyShot shot = GlossyShot(diffuse[j] * scale / kPi, lumel.position, lumel.size, 0u,
                                 g.shininess, lumel.area / kPi, j);
    if (lobes > 0.0)
        shot.lobes = g.shininess < kNarrowLobe ? 1u : min(p.before, kMostLobes);
    shots[k] = shot;

    // As many lobes, drawn by what they reflect: one from each part of their sum.
    const float part = lobes / float(max(shot.lobes, 1u));
    const float start = unit_float(hash(random)) * part;
    float below = 0.0;  // Σ of what the lobes before this one reflect
    uint l = 0u;
    for (uint earlier = 0u; earlier < p.before; ++earlier) {
        const float mine = lobe_power(j, earlier, y);
        const vec3 light = g.specular * last[earlier * p.count + j];
        const vec3 toward = normalize(before[earlier].position - y.position);
        below += mine;
        for (; l < shot.lobes && start + float(l) * part < below; ++l)
            lobes_sent[k * kMostLobes + l] = GlossyLobe(light * (scale * part / mine), toward);
    }
    // Rounding may have left the last one out.
    for (; l < shot.lobes; ++l)
        lobes_sent[k * kMostLobes + l] = GlossyLobe(vec3(0.0), y.normal);
}
