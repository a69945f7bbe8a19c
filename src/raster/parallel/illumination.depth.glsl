#ifndef LUMEL_VISIBILITY_ILLUMINATION_DEPTH_GLSL
#define LUMEL_VISIBILITY_ILLUMINATION_DEPTH_GLSL

// Depths in an illumination map, which may show only a part of the surfaces along the direction.

#include "raster/parallel/illumination_maps.shared.h"

float depth_of(IlluminationParams p, float nearness)
{
    return p.depth_scale * nearness + p.depth_shift;
}

float nearness_at(IlluminationParams p, float depth)
{
    return (depth - p.depth_shift) / p.depth_scale;
}

#endif
