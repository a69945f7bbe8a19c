#version 460
#include "methods/redistribution/paper_cross.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/eyes/sees.glsl"
#include "raster/eyes/hemicube.glsl"
#include "solve/shooting/receiver.glsl"

// [Hoef13] Algorithm 4.5, CrossProjectionReconstructionShader. Patches j of M send their light
// to the elements i of C and take away what they occlude, lamps included, Eq. (3.3.1):
//
//     ΔH_i = ± Σ_j F_ij (B_j^s - P(C, j, i)),      - at the old position, + at the new one
//
// and send to the elements of M at the new position, R_p(M, M): ΔH_i = Σ_j F_ij B_j^s.
//
// P is the mean of the light that rays from i through a grid on j meet on the hemicube on the back
// of j (ProjectedRadiosity). The cells of the grid are the lumels of the patch: 4 × 4 of them.
//
// With triangles, the incremental cross projection of section 4.5.2: rays that M occludes in its
// other position too are culled, and the form factor is that of the area left.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { PaperReceiveParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Shots { PatchShot shots[]; };
layout(scalar) readonly buffer Sent { vec3 shot[]; };
#include "methods/redistribution/cross.behind.glsl"
layout(scalar) readonly buffer Triangles { MoverTriangle triangles[]; };
layout(scalar) buffer Far { vec3 far[]; };

// Beyond this multiple of the patch's size, the patch counts as one disc (adaptive form factor
// subdivision, section 4.3.3).
const float kFar = 4.0;

// True if the segment from x by `ray` meets the triangle (Möller, Trumbore).
bool meets(MoverTriangle t, vec3 x, vec3 ray)
{
    const vec3 u = t.b - t.a, v = t.c - t.a, h = cross(ray, v);
    const float det = dot(u, h);
    if (det == 0.0)
        return false;
    const vec3 s = (x - t.a) / det, q = cross(s, u);
    const float at_u = dot(s, h), at_v = dot(ray, q), along = dot(v, q);
    return at_u >= 0.0 && at_v >= 0.0 && at_u + at_v <= 1.0 && along > 0.0 && along < 1.0;
}

bool is_culled(vec3 x, vec3 ray)
{
    bool any = false;
    for (uint t = 0u; t < p.triangles && !any; ++t)
        any = meets(triangles[t], x, ray);
    return any;
}

// Light that the ray from x through y meets behind the patch. Reproject: a ray of the same
// direction from the back eye predicts the distance from y at which it ends. Without, that ray is
// taken for the other, as in figure 4.5.3.
vec3 light_along(uint k, mat3 frame, vec3 x, vec3 y)
{
    const vec3 direction = normalize(y - x) * frame;
    const float inverse = direction.z > 0.0 ? inverse_behind(p.back, k, direction) : 0.0;
    if (inverse <= 0.0 || is_culled(x, y - x + frame * direction / inverse))
        return vec3(0.0);
    const vec3 toward = p.reprojects != 0u
                            ? (y - eyes[k].position) * frame + direction / inverse
                            : direction;
    return toward.z > 0.0 ? level_behind(p.back, k, 0u, toward) : vec3(0.0);
}

// A_j P(C, j, i)
vec3 projected_radiosity(uint k, vec3 x)
{
    const PatchShot s = shots[k];
    const mat3 frame = mat3(eyes[k].tangent, -eyes[k].bitangent, -eyes[k].normal);
    vec3 sum = vec3(0.0);
    for (uint j = s.first; j < s.first + s.count; ++j)
        sum += lumels[j].area * light_along(k, frame, x, lumels[j].position);
    return sum;
}

// F_ij / A_j by the disc approximation, Eq. (2.2.7).
float disc_factor(Receiver r, uint k)
{
    const PatchShot s = shots[k];
    const vec3 d = r.x - eyes[k].position;
    const float reach = kFar * s.size + r.size;
    const bool is_far = dot(d, d) >= reach * reach;
    float area = 0.0, sum = 0.0;
    for (uint j = s.first; j < s.first + s.count; ++j) {
        const Lumel from = lumels[j];
        area += from.area;
        if (!is_far)
            sum += from.area * point_factor(r.x - from.position, s.facing * from.normal, r.normal,
                                            from.area / kPi);
    }
    return (is_far ? point_factor(d, eyes[k].normal, r.normal, area / kPi) : sum / area) / kPi;
}

vec3 light_of_patch(Receiver r, uint k, bool is_of_movers)
{
    const PatchShot s = shots[k];
    const bool is_own = r.lumel >= s.first && r.lumel < s.first + s.count;
    if (is_own || !is_seen(r, eyes[k], k, p.views))
        return vec3(0.0);
    vec3 power = vec3(0.0);
    for (uint j = s.first; j < s.first + s.count && s.facing > 0.0; ++j)
        power += lumels[j].area * shot[j];
    if (!is_of_movers)
        power -= projected_radiosity(k, r.x);
    return disc_factor(r, k) * power;
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    const bool is_of_movers = (lumel.flags & kLumelMoving) != 0u;
    if ((lumel.flags & kLumelBuried) != 0u || (is_of_movers && p.sign_factor < 0.0))
        return;
    const Receiver r =
        receiver_at(LumelPoint(lumel.position, lumel.normal, lumel.normal, 0u), lumel, i);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.shots; ++k)
        if (shots[k].count > 0u)
            sum += light_of_patch(r, k, is_of_movers);
    far[i] += p.sign_factor * sum;
}
