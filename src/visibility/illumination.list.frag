#version 460
#include "visibility/illumination_maps.shared.h"
#include "visibility/illumination.glsl"

// A pixel of an illumination map that keeps all surfaces: put in front of the pixel's list.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(binding = 0, scalar) readonly buffer Views { ParallelView views[]; };
layout(binding = 1, scalar) buffer Heads { uint heads[]; };  // [tiles][side][side]
layout(binding = 2, scalar) writeonly buffer Fragments { Fragment fragments[]; };
layout(binding = 3, scalar) buffer Count { FragmentCount total; };
layout(location = 0) in vec2 place;

#include "visibility/parallel.glsl"
#include "visibility/illumination.list.glsl"

void main()
{
    append(p, surface_at(p, place));
}
