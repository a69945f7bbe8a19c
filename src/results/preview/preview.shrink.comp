#version 460
#include "base/images/tone_curve.shared.h"
#include "results/preview/preview.shared.h"

// Averages the samples of each pixel of the image: their radiance, or their display codes, so that
// edges of lamps are smooth too. Samples that are alike share one evaluation of the tone curve. The
// radiance of a sample is multiplied by its alpha, that of a pixel is not.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { ShrinkParams p; };
uniform sampler2D picture;
layout(scalar) writeonly buffer Pixels { vec4 pixels[]; };

const uint kSamples = kSupersample * kSupersample;
const float kAlike = 1.25;  // largest over smallest
const float kMinAlpha = 1e-6;

vec4 fetch(uint pixel, uint k)
{
    const uvec2 first = kSupersample * uvec2(pixel % p.width, pixel / p.width);
    return texelFetch(picture, ivec2(first + uvec2(k % kSupersample, k / kSupersample)), 0);
}

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.width * p.height)
        return;
    precise vec4 sum = vec4(0.0);  // in fixed order, for the same bits on every device
    vec4 low = vec4(1e38), high = vec4(0.0);
    for (uint k = 0u; k < kSamples; ++k) {
        const vec4 radiance = fetch(i, k);
        sum += radiance;
        low = min(low, radiance);
        high = max(high, radiance);
    }
    const float covered = max(sum.a, kMinAlpha);
    vec3 mean = sum.rgb / covered;
    if (p.exposure > 0.0) {
        // A loop, which software Vulkan leaves early.
        const bool alike = all(lessThanEqual(high, kAlike * low));
        const uint count = alike ? 1u : kSamples;
        precise vec3 codes = vec3(0.0);
        for (uint k = 0u; k < count; ++k) {
            const vec4 one = alike ? vec4(mean, 1.0) : fetch(i, k);
            codes += one.a * tone_curve(p.exposure * one.rgb / max(one.a, kMinAlpha));
        }
        mean = codes / (alike ? 1.0 : covered);
    }
    pixels[i] = vec4(mean, sum.a / float(kSamples));
}
