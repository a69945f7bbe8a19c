// The radiosity that a fragment shows. Needs lit_views.shared.h, atlas/lumel.shared.h and
// visibility/hemicube.glsl, and `uint lumel_of[]` and `vec3 radiosity[]` declared.

// B of the lumel at a place of the atlas [texels]; sides without lumels are black.
vec3 radiosity_at(LitParams p, vec2 place)
{
    const uvec2 texel = min(uvec2(max(place, vec2(0.0))), uvec2(p.width, p.height) - 1u);
    const uint back = gl_FrontFacing != is_mirrored(p.face) ? 0u : 1u;
    const uint j = lumel_of[2u * (texel.y * p.width + texel.x) + back];
    return j == kNoLumel ? vec3(0.0) : radiosity[j];
}
