#ifndef LUMEL_VISIBILITY_CHANNEL_GLSL
#define LUMEL_VISIBILITY_CHANNEL_GLSL

// Colour channels of a view.

#include "raster/world/passage.shared.h"

vec3 carried(uint channel)
{
    return channel == kAllChannels ? vec3(1.0)
                                   : vec3(equal(uvec3(channel - 1u), uvec3(0u, 1u, 2u)));
}

// If views take turns with the channels, each represents three.
uint channel_in_turn(uint index, bool in_turn)
{
    return in_turn ? 1u + index % kChannels : kAllChannels;
}

vec3 carried_in_turn(uint channel)
{
    return channel == kAllChannels ? vec3(1.0) : float(kChannels) * carried(channel);
}

#endif
