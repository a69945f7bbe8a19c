#version 460
#include "results/preview/preview.shared.h"

// Averages the samples of each pixel of the image.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { ShrinkParams p; };
uniform sampler2D picture;
layout(scalar) writeonly buffer Pixels { vec4 pixels[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.width * p.height)
        return;
    const ivec2 first = int(kSupersample) * ivec2(i % p.width, i / p.width);
    precise vec4 sum = vec4(0.0);  // in fixed order, for the same bits on every device
    for (int y = 0; y < int(kSupersample); ++y)
        for (int x = 0; x < int(kSupersample); ++x)
            sum += texelFetch(picture, first + ivec2(x, y), 0);
    pixels[i] = sum / float(kSupersample * kSupersample);
}
