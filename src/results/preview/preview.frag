#version 460
#include "results/preview/preview.glsl"

// All materials: discards backs that have their own face, and what another draw shows. Opacity and
// tint are those of sample_material().

uniform sampler2D base_color;
uniform sampler2D emissive;

void main()
{
    const vec4 glass_color = texture(base_color, look.xy) * p.base_color;
    const vec4 base = glass_color * color;
    const float there = p.cutoff < 0.0 ? clamp(base.a, 0.0, 1.0) : float(base.a >= p.cutoff);
    const float opacity = there * (1.0 - p.transmission);
    const bool is_solid = opacity >= p.solid, wants_solid = p.shows <= kShowsMap;
    if (is_solid != wants_solid || (p.back == kBackIsAnother && !gl_FrontFacing))
        discard;
    if (p.shows == kShowsTint) {
        const vec3 tint = clamp(glass_color.rgb, 0.0, 1.0);
        radiance = vec4(mix(vec3(1.0), tint, there * p.transmission / (1.0 - opacity)), 1.0);
        return;
    }
    show(base, texture(emissive, look.zw).rgb);
    if (p.shows == kShowsFilm)
        radiance *= opacity;
}
