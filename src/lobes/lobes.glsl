// The lobes of a shooter. The includer declares `GlossyLobe lobes_sent[]` and includes
// phong.lobe.glsl.

// What the lobes of shooter k, taken for as wide as that shininess, send along a unit direction:
// radiance × A_j / (p_j K).
vec3 lobes_toward(uint k, GlossyShot shot, Eye eye, vec3 direction, float shininess)
{
    vec3 sum = vec3(0.0);
    for (uint l = 0u; l < shot.lobes; ++l) {
        const GlossyLobe lobe = lobes_sent[k * kMostLobes + l];
        sum += lobe.specular * phong_lobe(lobe.toward, direction, eye.normal, shininess);
    }
    return sum;
}
