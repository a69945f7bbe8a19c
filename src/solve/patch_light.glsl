// The light that a patch sends to a point. The includer declares `Lumel lumels[]`, `Eye eyes[]`,
// `PatchShot shots[]`, `vec3 sending[]`, and includes visibility/sees.glsl.

// From so many times the patch's size away it counts as one point.
const float kFar = 4.0;

struct PatchReceiver {
    vec3 x, normal, facing;  // of the receiving point
    vec3 centre;             // of its lumel
    float size;              // of its lumel
    uint lumel;
};

// A_j cosθ_i cosθ_j / (π r²) of a point source; `d` leads from it to the receiving point.
float point_factor(vec3 d, vec3 normal_j, vec3 normal_i)
{
    const float r2 = dot(d, d);
    return max(dot(d, normal_j), 0.0) * max(-dot(d, normal_i), 0.0) / (r2 * r2);
}

// [Hoef13] Eq. (2.2.8), with the disc of each lumel where the patch is close (adaptive form factor
// subdivision, section 4.3.3). Pairs of the near field are left out, and with them the term A_j:
// the near field holds them exactly.
vec3 light_without_occluders(PatchReceiver r, uint k, float near_radius)
{
    const PatchShot s = shots[k];
    const vec3 d = r.x - eyes[k].position;
    const float near_reach = near_radius * max(r.size, s.lumel_size) + r.size;
    const float reach = max(kFar, 1.0) * s.size + near_reach;
    if (dot(d, d) >= reach * reach)
        return s.power * point_factor(d, eyes[k].normal, r.normal);
    vec3 sum = vec3(0.0);
    for (uint j = s.first; j < s.first + s.count; ++j) {
        const Lumel lumel = lumels[j];
        const vec3 between = r.centre - lumel.position;
        const float near = near_radius * max(r.size, lumel.size);
        if (dot(between, between) >= near * near && j != r.lumel) {
            const vec3 from = s.parts > 1u ? eyes[k].position : lumel.position;
            sum += sending[j] * (lumel.area * point_factor(r.x - from, lumel.normal, r.normal));
        }
    }
    return sum / kPi;
}

// The patch's eye decides for all its lumels.
bool is_seen(PatchReceiver r, uint k, EyeViewLayout layout_)
{
    const Eye eye = eyes[k];
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    const vec3 d = r.x - eye.position;
    const vec3 local = d * frame;
    return local.z > 0.0 && dot(d, r.normal) < 0.0 && sees(layout_, k, local, r.facing * frame);
}
