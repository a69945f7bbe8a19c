#version 460
#include "methods/glossy/glossy.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "methods/glossy/phong.glsl"
#include "methods/glossy/lobes.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "raster/near/near_pairs.glsl"
#include "raster/near/near_factor.glsl"

// Every lumel receives from all K shots ([BSS05] Eq. (4)), stores the actual irradiance from each
// for the next iteration's reflections, and adds it to the running average:
//
//     I_k = L_j(ω) V cosθ_i cosθ_j / r² · A_j / (p_j K),
//     B_i = E_i + Σ_k I_k a_i(ω_k) + near light, by whose power the next shooters are drawn.
//
// Near pairs exchange diffuse light in the near field; shots at them have lobes only, with the same
// form factors. Scheme::paper has no near field and takes r² + A_j/π for r², Eq. (8).
//
// If particles carry the light of lobes (lobe_particles.cpp), shooters send none, and B_i lacks it:
// it counts as not absorbed, and arrives elsewhere with the particles.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { GlossyReceiveParams p; };
layout(scalar) uniform Eyes { Eye eyes[kMaxGlossyBatch]; };
layout(scalar) uniform Shots { GlossyShot shots[kMaxGlossyBatch]; };
layout(scalar) readonly buffer Glosses { Gloss gloss[]; };
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) readonly buffer Near { vec3 near[]; };
layout(scalar) writeonly buffer Last { vec3 last[]; };  // [K][N]
layout(scalar) buffer Sums { vec3 sums[]; };  // [2][N] of H
layout(scalar) writeonly buffer Exitance { vec3 exitance[]; };  // [N] B
layout(scalar) buffer Absorbed { vec3 absorbed[]; };  // [2][N] sums
layout(scalar) writeonly buffer Diffuse { vec3 diffuse_exitance[]; };  // [N]
layout(scalar) readonly buffer Carried { vec3 carried[]; };  // [N] by particles
layout(scalar) readonly buffer Passed { vec3 passed_on[]; };  // [N] of that, reflected by lobes

// Between near lumels a narrower lobe would be hit or missed by chance.
const float kMaxNearShininess = 100.0;

// Lobes averaged over sending and receiving lumel. Squares of side s at distance r spread the
// directions between them by a variance of s² / 6r²; a lobe of exponent n has 2 / n, so that the
// mean over both is about a lobe of
//
//     1 / n' = 1 / n + (s_i² + s_j²) / 12 r²,
//
// scaled by the albedos of both exponents, which preserves the light reflected of uniform light.
vec3 mean_lobes(uint k, GlossyShot shot, Eye eye, Lumel lumel, vec3 way, float r2)
{
    if (shot.lobes == 0u)
        return vec3(0.0);
    const float spread = (lumel.size * lumel.size + shot.size * shot.size) / (12.0 * r2);
    const float wide = max(shot.shininess / (1.0 + shot.shininess * spread), 1.0);
    const float cos_out = dot(way, eye.normal);
    const float scale = phong_albedo(cos_out, shot.shininess) / phong_albedo(cos_out, wide);
    return scale * lobes_toward(k, shot, eye, way, wide);
}

// I_k at a point of lumel i; `cos_in` is its cosine there.
vec3 receive(uint i, Lumel lumel, LumelPoint x, uint k, out float cos_in)
{
    const Eye eye = eyes[k];
    const vec3 d = x.position - eye.position;
    const float toward_j = dot(d, eye.normal);
    const float toward_i = -dot(d, x.normal);
    cos_in = 0.0;
    if (toward_j <= 0.0 || toward_i <= 0.0 || dot(d, x.facing) >= 0.0)
        return vec3(0.0);
    const GlossyShot shot = shots[k];
    const bool is_close =
        is_near(lumel.position, lumel.size, shot.centre, shot.size, p.near_radius);
    if (shot.lumel == i || (is_close && shot.lobes == 0u))
        return vec3(0.0);
    const float r2 = dot(d, d);
    const vec3 way = d * inversesqrt(r2);
    cos_in = -dot(way, x.normal);
    if (is_close)  // π F_ij replaces the geometry and visibility of all points
        return lobes_toward(k, shot, eye, way, min(shot.shininess, kMaxNearShininess)) *
               near_factor(i, shot.lumel) / shot.disc;
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    if (!sees(p.views, k, d * frame, x.facing * frame))
        return vec3(0.0);
    const float disc = p.near_radius == 0.0 ? shot.disc : 0.0;
    return (shot.diffuse + mean_lobes(k, shot, eye, lumel, way, r2)) *
           (toward_i * toward_j / (r2 * (r2 + disc)));
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    const Gloss g = gloss[i];
    const bool open = (lumel.flags & kLumelBuried) == 0u;
    const LumelPoint x = receiving_point(lumel, i, p.iteration, p.seed, p.centre != 0u);
    const bool particles = p.particles != 0u;
    const vec3 near_lobes = near[i] * g.specular * phong_mean_albedo(g.shininess);
    vec3 sum = near[i];
    vec3 diffuse = near[i] * g.diffuse;
    vec3 lobes = vec3(0.0);
    if (particles) {
        sum += carried[i];
        diffuse += carried[i] * g.diffuse;
        lobes = near_lobes + passed_on[i];
    } else
        diffuse += near_lobes;
    for (uint k = 0u; k < p.shots; ++k) {
        float cos_in = 0.0;
        const vec3 irradiance = open ? receive(i, lumel, x, k, cos_in) : vec3(0.0);
        if (!particles)
            last[k * p.count + i] = irradiance;
        sum += irradiance;
        diffuse += irradiance * g.diffuse;
        lobes += irradiance * g.specular * phong_albedo(cos_in, g.shininess);
    }
    diffuse_exitance[i] = emission[i] + diffuse;
    exitance[i] = emission[i] + diffuse + (particles ? vec3(0.0) : lobes);
    const uint at = p.half_index * p.count + i;
    sums[at] += sum;
    absorbed[at] += sum - diffuse - lobes;
}
