#version 460
#include "solve/shooting/iteration.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "solve/shooting/iteration.glsl"

// The current solution, and the difference between its two independent halves:
//
//     H = mean over h of (D_h + far_h)  +  near light,    by shots with the papers' scheme,
//     terms: Σ |H_0 - H_1|²/4 over channels (the mean's expected squared error), Σ H, N,
//            Σ A 𝓛(ρH);
//            Σ |H_0 - H_1|²/4 / (H'² + dim²), relative to each lumel's own light: H' is H plus the
//            given irradiance.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { AverageParams p; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Direct { vec3 direct[]; };
layout(scalar) readonly buffer Indirect { vec3 indirect[]; };
layout(scalar) readonly buffer NearEmission { vec3 near_emission[]; };
layout(scalar) readonly buffer NearSource { vec3 near_source[]; };
layout(scalar) readonly buffer Earlier { vec3 earlier[]; };  // [2][N]
layout(scalar) readonly buffer Known { vec3 known[]; };  // given irradiance
layout(scalar) writeonly buffer Far { vec3 far[]; };
layout(scalar) writeonly buffer Irradiance { vec3 irradiance[]; };
layout(scalar) writeonly buffer Parts { Terms parts[]; };

#include "solve/shooting/sum.glsl"

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    Terms terms = no_terms();
    if (i < p.count && surface[i].w > 0.0) {
        vec3 halves[2], near = vec3(0.0);
        for (uint h = 0u; h < 2u; ++h) {
            // A half without shots uses those of the other half.
            const uint e = p.averages.emission_shots[h] > 0.0 ? h : 1u - h;
            const uint s = has_indirect(p.averages, h) ? h : 1u - h;
            const uint at = s * p.count + i;
            const vec3 near_light = level(p.averages, s) * near_source[i];
            halves[h] = mean(direct[e * p.count + i], p.averages.emission_shots[e]) +
                        far_indirect(p.averages, s, indirect[at], earlier[at]) + near_light;
            near += 0.5 * near_light;
        }
        const float share = share_of_first(p.averages);
        const vec3 average = share * halves[0] + (1.0 - share) * halves[1];
        const vec3 h_i = average + near_emission[i];
        far[i] = average - near;
        irradiance[i] = h_i;

        const vec3 d = 0.5 * (halves[0] - halves[1]);
        terms.column[0] = vec4(dot(d, d), h_i.r + h_i.g + h_i.b, 1.0,
                               surface[i].w * luminance(surface[i].rgb * h_i));
        const vec3 all_light = h_i + known[i];
        terms.column[1].x = dot(d, d) / (dot(all_light, all_light) / 3.0 + p.dim * p.dim + 1e-30);
    } else if (i < p.count) {
        far[i] = vec3(0.0);
        irradiance[i] = vec3(0.0);
    }
    terms = add_over_group(terms, 2u);
    if (gl_LocalInvocationID.x == 0u)
        parts[gl_WorkGroupID.x] = terms;
}
