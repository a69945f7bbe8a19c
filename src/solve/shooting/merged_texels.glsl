#ifndef LUMEL_SHOOTING_MERGED_TEXELS_GLSL
#define LUMEL_SHOOTING_MERGED_TEXELS_GLSL

// Texels that shoot as one, [BSS05] section 5: those of a square of 2^merge × 2^merge texels that
// lie on one chart.

#include "raster/world/lumel.glsl"

// Lumels are ordered by chart and along a Morton curve, so those of a square are neighbours.
uint merge_reach(uint merge)
{
    return (1u << (2u * merge)) - 1u;
}

uint first_of_square(uint j, uint merge)
{
    return j - min(j, merge_reach(merge));
}

uint last_of_square(uint j, uint merge, uint count)
{
    return min(j + merge_reach(merge), count - 1u);
}

bool shoot_as_one(Lumel j, Lumel m, uint merge, uint width)
{
    const uvec2 a = uvec2(j.texel % width, j.texel / width) >> merge;
    const uvec2 b = uvec2(m.texel % width, m.texel / width) >> merge;
    return a == b && j.chart == m.chart && (m.flags & kLumelBuried) == 0u;
}

struct MergedPlace {
    vec3 position;  // ȳ [m]
    vec3 normal;
    float area;  // Σ A_m [m²]
};

// The centre of the square around j. On a convex chart it is lifted to the highest texel, or the
// surface would occlude it.
MergedPlace merged_place(uint j, uint merge, uint count, uint width)
{
    const Lumel lumel = lumels[j];
    const uint first = first_of_square(j, merge), last = last_of_square(j, merge, count);
    MergedPlace place = MergedPlace(vec3(0.0), vec3(0.0), 0.0);
    for (uint m = first; m <= last; ++m)
        if (shoot_as_one(lumel, lumels[m], merge, width)) {
            place.position += (lumels[m].position - lumel.position) * lumels[m].area;
            place.normal += lumels[m].normal * lumels[m].area;
            place.area += lumels[m].area;
        }
    const vec3 mean = place.area > 0.0 ? place.position / place.area : vec3(0.0);
    place.normal = dot(place.normal, lumel.normal) > 0.0 ? normalize(place.normal) : lumel.normal;
    float highest = 0.0;
    for (uint m = first; m <= last; ++m)
        if (shoot_as_one(lumel, lumels[m], merge, width))
            highest =
                max(highest, dot(lumels[m].position - lumel.position - mean, place.normal));
    place.position = lumel.position + mean + highest * place.normal;
    return place;
}

#endif
