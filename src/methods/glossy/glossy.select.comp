#version 460
#include "methods/glossy/glossy.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "solve/shooting/power_pyramid.glsl"
#include "raster/world/lumel.glsl"
#include "methods/glossy/phong.glsl"
#include "solve/shooting/shooter.glsl"
#include "solve/shooting/merged_texels.glsl"
#include "raster/world/channel.glsl"

// Draws the shooters of one iteration in proportion to their power ([BSS05] section 4.1) and
// prepares their light ([BSS05] Eq. (7)): emission and diffuse light as one value, and lobes of the
// earlier shooters that lit them.
//
// Scheme::paper can draw some by area alone. A shooter that either technique can draw is weighted
// by the balance heuristic [VG95]: division by the mean of both probabilities.
//
// Merged ([BSS05] section 5), the texels of a square shoot as one from their common centre, with
// their mean radiance times their area, drawn with the sum of their probabilities.

layout(local_size_x = kGlossySelectGroup) in;
layout(push_constant, scalar) uniform Params { GlossySelectParams p; };
layout(scalar) readonly buffer Glosses { Gloss gloss[]; };
layout(scalar) readonly buffer Diffuse { vec3 diffuse[]; };  // [N] exitance
layout(scalar) readonly buffer Last { vec3 last[]; };  // [K][N] I of each shooter
layout(scalar) readonly buffer Power { float power[]; };
layout(scalar) readonly buffer AreaPower { float area_power[]; };
layout(scalar) readonly buffer Before { Eye before[]; };  // [K] earlier shooters
layout(scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(scalar) writeonly buffer Shots { GlossyShot shots[]; };
layout(scalar) writeonly buffer Lobes { GlossyLobe lobes_sent[]; };  // [K][most]

// Position and probability of a shooter.
struct Sender {
    uint lumel;
    vec3 position, normal;
    float area;         // [m²]
    float probability;  // probability of drawing it
};

// Σ_m A_m B_m of light that is equal in all directions.
vec3 diffuse_power(uint j)
{
    vec3 sum = vec3(0.0);
    const uint last_one = last_of_square(j, p.merge, p.count);
    for (uint m = first_of_square(j, p.merge); m <= last_one; ++m)
        if (shoot_as_one(lumels[j], lumels[m], p.merge, p.width))
            sum += lumels[m].area * diffuse[m];
    return sum;
}

// Σ_m A_m ρ_s I_m,k: light of earlier shooter k on the lobes.
vec3 light_on_lobes(uint j, uint k)
{
    vec3 sum = vec3(0.0);
    const uint last_one = last_of_square(j, p.merge, p.count);
    for (uint m = first_of_square(j, p.merge); m <= last_one; ++m)
        if (shoot_as_one(lumels[j], lumels[m], p.merge, p.width))
            sum += lumels[m].area * gloss[m].specular * last[k * p.count + m];
    return sum;
}

float probability_of(uint j)
{
    const uint top = p.pyramid.first[p.pyramid.levels - 1u], leaves = p.pyramid.first[0];
    const uint last_one = last_of_square(j, p.merge, p.count);
    float by_power = 0.0, by_area = 0.0;
    for (uint m = first_of_square(j, p.merge); m <= last_one; ++m)
        if (shoot_as_one(lumels[j], lumels[m], p.merge, p.width)) {
            by_power += power[leaves + m];
            by_area += area_power[leaves + m];
        }
    return (1.0 - p.area_share) * share_of(by_power, power[top]) +
           (p.area_share > 0.0 ? p.area_share * share_of(by_area, area_power[top]) : 0.0);
}

Sender draw(vec3 u, bool by_area)
{
    Drawn drawn;
    if (by_area)
        DRAW_FROM(area_power, p.pyramid, u.x, drawn)
    else
        DRAW_FROM(power, p.pyramid, u.x, drawn)
    const uint j = drawn.lumel;
    const LumelPoint y = point_on(lumels[j], u.y, u.z);
    Sender sender = Sender(j, y.position, y.normal, lumels[j].area, drawn.probability);
    if (p.centre != 0u && drawn.probability > 0.0) {
        const MergedPlace place = merged_place(j, p.merge, p.count, p.width);
        sender = Sender(j, place.position, place.normal, place.area, probability_of(j));
    }
    return sender;
}

// Weight of a lobe: the luminance of ρ_s I_k a(ω_k) A.
float lobe_power(Sender y, uint k)
{
    const vec3 toward = normalize(before[k].position - y.position);
    return luminance(light_on_lobes(y.lumel, k)) *
           phong_albedo(dot(toward, y.normal), gloss[y.lumel].shininess);
}

// `count` lobes, drawn by reflected light: one from each part of their sum.
void send_lobes(uint k, Sender y, vec3 scale, uint count, float lobes, uint random)
{
    const float part = lobes / float(max(count, 1u));
    const float start = unit_float(hash(random)) * part;
    float below = 0.0;  // Σ of the light reflected by earlier lobes
    uint l = 0u;
    for (uint earlier = 0u; earlier < p.before; ++earlier) {
        const float mine = lobe_power(y, earlier);
        if (mine < kMinDivisor)
            continue;
        const vec3 light = light_on_lobes(y.lumel, earlier);
        const vec3 toward = normalize(before[earlier].position - y.position);
        below += mine;
        for (; l < count && start + float(l) * part < below; ++l)
            lobes_sent[k * kMaxLobes + l] = GlossyLobe(light * (scale * part / mine), toward);
    }
    // Rounding can leave out the last ones.
    for (; l < count; ++l)
        lobes_sent[k * kMaxLobes + l] = GlossyLobe(vec3(0.0), y.normal);
}

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.shots)
        return;
    const uint index = p.index + k;
    // Iterations must be independent: each has its own sequence.
    const Sender y = draw(draw_point(k, hash(p.index), p.seed, p.random != 0u),
                          k < p.area_shots);
    const Gloss g = gloss[y.lumel];
    const uint random = hash(hash(index ^ hash(p.seed)) + 1u);
    const uint channel = channel_in_turn(index, p.channels != 0u);
    eyes[k] = make_eye(y.position, y.normal, random, channel);

    float lobes = 0.0;
    for (uint e = 0u; e < p.before; ++e)
        lobes += lobe_power(y, e);
    const vec3 scale = y.probability > 0.0
                           ? carried_in_turn(channel) / (y.probability * float(p.shots))
                           : vec3(0.0);
    GlossyShot shot =
        GlossyShot(diffuse_power(y.lumel) * scale / kPi, lumels[y.lumel].position,
                   max(lumels[y.lumel].size, sqrt(y.area)), 0u, g.shininess, y.area / kPi, y.lumel);
    if (lobes >= kMinDivisor)
        shot.lobes = g.shininess < kNarrowLobe ? 1u : min(p.before, kMaxLobes);
    shots[k] = shot;
    send_lobes(k, y, scale, shot.lobes, lobes, random);
}
