// Tone mapping from linear light to display codes.
//
//     x = exposure · value                             per channel
//     y = x                                            for x ≤ a    (unchanged below the shoulder)
//     y = a + (1 − a) (1 − exp(−(x − a) / (1 − a)))    for x > a    (never reaches 1)
//     code = sRGB curve of y                           IEC 61966-2-1
//
// The curve and its slope are continuous at a. The exposure maps the bright end to just below
// white: the 98th percentile of luminance, at most 8 times the median, so that a lamp that covers
// much of the image does not darken the rest.

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/core/parallel.h"
#include "base/images/image_files.h"

namespace lumel {
namespace {

constexpr float kShoulder = 0.6f;          // a
constexpr float kBrightEnd = 0.9f;         // x of the bright end; y = 0.81, code value 232
constexpr double kBrightShare = 0.98;      // percentile taken as the bright end
constexpr float kBrightOverMedian = 8.0f;  // beyond this it is a lamp, not a lit surface
constexpr std::size_t kGrain = 4096;       // texels per task

float luminance(const float* rgb)
{
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];  // Rec. 709
}

float percentile(std::vector<float>& values, double share)
{
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace

float srgb_from_linear(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float display_from_linear(float exposed)
{
    const float x = std::fmax(exposed, 0.0f);
    const float y = x <= kShoulder
                        ? x
                        : kShoulder + (1.0f - kShoulder) *
                                          (1.0f - std::exp(-(x - kShoulder) / (1.0f - kShoulder)));
    return srgb_from_linear(y);
}

float bright_end(const Image& linear)
{
    // Black texels have no information about the brightness of the light.
    std::vector<float> lit;
    const std::size_t stride = std::size_t(linear.channels);
    for (std::size_t i = 0; i + stride <= linear.values.size(); i += stride) {
        const float* texel = linear.values.data() + i;
        const bool covered = linear.channels < 4 || texel[3] > 0.0f;
        if (covered && luminance(texel) > 0.0f && std::isfinite(luminance(texel)))
            lit.push_back(luminance(texel));
    }
    if (lit.empty())
        return 0.0f;
    return std::min(percentile(lit, kBrightShare), kBrightOverMedian * percentile(lit, 0.5));
}

float choose_exposure(const Image& linear)
{
    const float bright = bright_end(linear);
    return bright > 0.0f ? kBrightEnd / bright : 1.0f;
}

Image tone_map(const Image& linear, float exposure)
{
    if (exposure <= 0.0f)
        exposure = choose_exposure(linear);
    Image display = linear;
    const std::size_t stride = std::size_t(linear.channels);
    parallel_for(display.values.size() / stride, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t texel = first; texel < last; ++texel)
            for (std::size_t c = 0; c < 3; ++c) {
                float& value = display.values[texel * stride + c];
                value = display_from_linear(exposure * value);
            }
    });
    return display;
}

}  // namespace lumel
