#version 460
#include "solve/glossy.shared.h"
#include "core/hash.glsl"
#include "solve/radiosity.glsl"
#include "solve/power_pyramid.glsl"

// Draws the shooters of one iteration in proportion to their power ([BSS05] section 4.1) and
// prepares what they send ([BSS05] Eq. (7)): their emission and diffuse light whole, and the lobe
// of one of the earlier shooters that lit them, drawn by what the lobe reflects.

layout(local_size_x = kGlossySelectGroup) in;
layout(push_constant, scalar) uniform Params { GlossySelectParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Glosses { Gloss gloss[]; };
layout(binding = 3, scalar) readonly buffer Emission { vec3 emission[]; };
layout(binding = 4, scalar) readonly buffer Last { vec3 last[]; };   // [K][N] I of each shooter
layout(binding = 5, scalar) readonly buffer Near { vec3 near[]; };   // [N] near light
layout(binding = 6, scalar) readonly buffer Power { float power[]; };
layout(binding = 7, scalar) readonly buffer Before { Eye before[]; };  // [K] earlier shooters
layout(binding = 8, scalar) readonly buffer Table { float albedo_table[]; };
layout(binding = 9, scalar) writeonly buffer Eyes { Eye eyes[]; };
layout(binding = 10, scalar) writeonly buffer Shots { GlossyShot shots[]; };

#include "world/lumel.glsl"
#include "solve/phong.glsl"
#include "solve/shooter.glsl"

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
    const PyramidLayout layout_ = p.layout_;
    Drawn drawn;
    DRAW_FROM(power, u.x)

    const uint j = drawn.lumel;
    const Lumel lumel = lumels[j];
    const Gloss g = gloss[j];
    const LumelPoint y = point_on(lumel, u.y, u.z);
    const uint random = hash(hash(index ^ hash(p.seed)) + 1u);
    eyes[k] = make_eye(y.position, y.normal, random);

    vec3 irradiance = vec3(0.0);
    float lobes = 0.0;
    for (uint e = 0u; e < p.before; ++e) {
        irradiance += last[e * p.count + j];
        lobes += lobe_power(j, e, y);
    }
    const vec3 diffuse = emission[j] + g.diffuse * (irradiance + near[j]) +
                         g.specular * near[j] * phong_mean_albedo(g.shininess);
    const float scale =
        drawn.probability > 0.0 ? lumel.area / (drawn.probability * float(p.shots)) : 0.0;
    GlossyShot shot = GlossyShot(diffuse * scale / kPi, vec3(0.0), y.normal, lumel.position,
                                 lumel.size, g.shininess,
                                 lumel.area / kPi, j);
    float rest = unit_float(hash(random)) * lobes;
    for (uint e = 0u; e < p.before && lobes > 0.0; ++e) {
        const float mine = lobe_power(j, e, y);
        if (mine > 0.0 && rest < mine) {
            shot.specular = g.specular * last[e * p.count + j] * (scale * lobes / mine);
            shot.toward = normalize(before[e].position - y.position);
            break;
        }
        rest -= mine;
    }
    shots[k] = shot;
}
