#version 460
#include "results/preview/preview.shared.h"

// A pixel of the picture is the mean of those that were drawn for it.

layout(local_size_x = kShrinkGroup) in;
layout(push_constant, scalar) uniform Params { ShrinkParams p; };
uniform sampler2D picture;
layout(scalar) writeonly buffer Pixels { vec4 pixels[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.width * p.height)
        return;
    const ivec2 first = int(kSupersample) * ivec2(i % p.width, i / p.width);
    precise vec4 sum = vec4(0.0);  // in one order, so that every device has the same bits
    for (int y = 0; y < int(kSupersample); ++y)
        for (int x = 0; x < int(kSupersample); ++x)
            sum += texelFetch(picture, first + ivec2(x, y), 0);
    pixels[i] = sum / float(kSupersample * kSupersample);
}
