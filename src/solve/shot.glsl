// Which shots reach a lumel. The includer declares `Eye eyes[]` and `Shot shots[]`, and includes
// visibility/sees.glsl.

struct Receiver {
    vec3 x, normal, facing;  // of the receiving point
    vec3 centre;             // of its lumel
    float size;              // of its lumel
    uint lumel;
};

// Does the light of shot k arrive, from the front and not through the near field? `d` leads from
// the shooter to the receiving point.
bool arrives(Receiver r, uint k, EyeViewLayout layout_, float near_radius, out vec3 d)
{
    const Eye eye = eyes[k];
    d = r.x - eye.position;
    if (dot(d, eye.normal) <= 0.0 || dot(d, r.normal) >= 0.0)
        return false;
    const vec3 between = r.centre - shots[k].centre;
    const float reach = near_radius * max(r.size, shots[k].size);
    if (dot(between, between) < reach * reach || shots[k].lumel == r.lumel)
        return false;
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    return sees(layout_, k, d * frame, r.facing * frame);
}
