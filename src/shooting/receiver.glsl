// A lumel that receives, and whether an eye sees it. The includer declares `Eye eyes[]`, and
// includes world/lumel.glsl and visibility/sees.glsl.

struct Receiver {
    vec3 x, normal, facing;  // of the receiving point
    vec3 centre;             // of its lumel
    float size;              // of its lumel
    uint lumel;
};

Receiver receiver_at(LumelPoint x, Lumel lumel, uint i)
{
    return Receiver(x.position, x.normal, x.facing, lumel.position, lumel.size, i);
}

// Does eye k, in tile k, see the receiving point, and from the front?
bool is_seen(Receiver r, uint k, EyeViewLayout layout_)
{
    const Eye eye = eyes[k];
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    const vec3 d = r.x - eye.position;
    const vec3 local = d * frame;
    return local.z > 0.0 && dot(d, r.normal) < 0.0 && sees(layout_, k, local, r.facing * frame);
}
