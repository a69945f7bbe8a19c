#ifndef LUMEL_VISIBILITY_ILLUMINATION_LIST_GLSL
#define LUMEL_VISIBILITY_ILLUMINATION_LIST_GLSL

// Lists of an illumination map of all surfaces. Declares `heads`, `fragments` and `total`.

#include "raster/parallel/illumination_maps.shared.h"
#include "raster/parallel/parallel.glsl"

layout(scalar) buffer Heads { uint heads[]; };  // [tiles][side][side]
layout(scalar) writeonly buffer Fragments { Fragment fragments[]; };
layout(scalar) buffer Count { FragmentCount total; };

// Prepends a surface to the pixel's list, if there is capacity.
void append(IlluminationParams p, uint surface)
{
    const uint index = atomicAdd(total.count, 1u);
    if (index >= total.capacity) {
        atomicMax(total.most, index + 1u);
        return;
    }
    const uint side = p.tiling.side;
    const uvec2 pixel = uvec2(gl_FragCoord.xy) - tile_corner(p.tiling, p.tile);
    const uint head = (p.tile * side + pixel.y) * side + pixel.x;
    fragments[index] = Fragment(surface, gl_FragCoord.z, atomicExchange(heads[head], index));
}

#endif
