#version 460
#include "methods/glossy/eye_image.shared.h"
#include "methods/glossy/lobes.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "methods/glossy/phong.lobe.glsl"
#include "methods/glossy/lobes.glsl"
#include "raster/eyes/sees.glsl"

// Light of the K shooters of an iteration, reflected by points to the eye ([BSS05] Eq. (6)):
//
//     C ← C + Σ_k w L_j(ω) ρ_s f_r(ω, ω_eye) V cosθ cosθ_j / r² · A_j / (p_j K)
//
// With rays along the lobe that find the same light (results/picture/lobe_rays.cpp), w is the
// balance heuristic [VG95] of both techniques to choose y, as densities per solid angle:
//
//     w = n_A q_A / (n_A q_A + n_B q_B),     q_A = 𝓛(B_j) / Φ · r² / cosθ_j,  q_B = the lobe's.
//
// The shooters' own lobes are left to the rays. Without rays w is 1 and shooters send lobes; the
// disc of Eq. (8) then bounds the light of close shooters.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { EyeParams p; };
layout(scalar) readonly buffer Points { EyePoint points[]; };
layout(scalar) uniform Eyes { Eye eyes[kMaxGlossyBatch]; };
layout(scalar) uniform Shots { GlossyShot shots[kMaxGlossyBatch]; };
layout(scalar) readonly buffer Density { float density[]; };  // [N] 𝓛(B_j)/Φ [1/m²]
layout(scalar) buffer Sums { vec3 sums[]; };  // [P] C

vec3 reflect_to_eye(EyePoint x, uint k)
{
    const Eye eye = eyes[k];
    const vec3 d = x.position - eye.position;
    const float toward_j = dot(d, eye.normal);
    const float toward_i = -dot(d, x.normal);
    if (toward_j <= 0.0 || toward_i <= 0.0 || dot(d, x.facing) >= 0.0)
        return vec3(0.0);
    const float r2 = dot(d, d);
    const vec3 direction = d * inversesqrt(r2);
    const float lobe = phong_lobe(-direction, x.toward_eye, x.normal, x.shininess);
    if (lobe <= 0.0)
        return vec3(0.0);
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    if (!sees(p.views, k, d * frame, x.facing * frame))
        return vec3(0.0);

    const GlossyShot shot = shots[k];
    if (p.rays == 0.0)
        return (shot.diffuse + lobes_toward(k, shot, eye, direction, shot.shininess)) *
               (lobe * toward_i * toward_j / (r2 * (r2 + shot.disc)));
    const float shooters = p.shooters * density[shot.lumel] * r2 * sqrt(r2) / toward_j;
    const float cos_out = dot(x.normal, x.toward_eye);
    const float rays = p.rays * lobe * max(toward_i * inversesqrt(r2), cos_out);
    const float weight = shooters > 0.0 ? shooters / (shooters + rays) : 0.0;
    return shot.diffuse * (weight * lobe * toward_i * toward_j / (r2 * r2));
}

void main()
{
    const uint e = p.range.first + gl_GlobalInvocationID.x;
    if (e >= p.range.last)
        return;
    const EyePoint x = points[e];
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.shots; ++k)
        sum += reflect_to_eye(x, k);
    sums[e] += x.specular * sum;
}
