// Exposure of images, and their tone mapping (curve: tone_curve.shared.h).
//
// The exposure maps the log-average of the image's luminance to a key a [RSSF02]:
//
//     exposure = a / exp2(m),    m = mean of log2 L
//
// 0.18 is mid grey: display code 0.5. An image most of which is as bright as its bright end, such
// as one of a white room, is meant to be bright. The key follows from where m is in the range of
// log2 L [Rei02], up to one stop over mid grey, but not below it: the curve has room for lamps and
// sun.
//
//     a = 0.18 · 4^f,    f = (2m − low − high) / (high − low),    in 0…1/2
//
// low and high are percentiles, which also bound log2 L in the mean: lamps in view do not count if
// they cover less than 5 % of the image. Black pixels do not count either.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "base/images/image_files.h"
#include "base/images/tone_curve.shared.h"

namespace lumel {
namespace {

constexpr double kMidGrey = 0.18;
constexpr double kMaxRaise = 0.5;            // of f
constexpr double kLow = 0.05, kHigh = 0.95;  // percentiles
constexpr float kBlack = 1.0f / 1024.0f;     // of the high percentile: black on the display
constexpr std::size_t kGrain = 4096;         // texels per task

double percentile(std::vector<float>& values, double share)
{
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return double(*place);
}

/// Luminances of covered, lit pixels.
std::vector<float> lit_pixels(const Image& linear)
{
    std::vector<float> lit;
    const std::size_t stride = std::size_t(linear.channels);
    for (std::size_t i = 0; i + stride <= linear.values.size(); i += stride) {
        const float* const pixel = linear.values.data() + i;
        const float value = float(luminance({pixel[0], pixel[1], pixel[2]}));
        if ((linear.channels < 4 || pixel[3] > 0.0f) && value > 0.0f && std::isfinite(value))
            lit.push_back(value);
    }
    return lit;
}

}  // namespace

std::optional<float> choose_exposure(const Image& linear)
{
    std::vector<float> lit = lit_pixels(linear);
    if (lit.empty())
        return std::nullopt;
    const double bright = percentile(lit, kHigh);
    std::erase_if(lit, [&](float value) { return value < kBlack * float(bright); });
    const double low = std::log2(percentile(lit, kLow)), high = std::log2(bright);
    double sum = 0.0;
    for (const float value : lit)
        sum += std::clamp(std::log2(double(value)), low, high);
    const double mean = sum / double(lit.size());
    const double f = high > low ? (2.0 * mean - low - high) / (high - low) : 0.0;
    return float(kMidGrey * std::exp2(2.0 * std::clamp(f, 0.0, kMaxRaise) - mean));
}

Image tone_map(const Image& linear, float exposure)
{
    Image display = linear;
    const std::size_t stride = std::size_t(linear.channels);
    parallel_for(display.values.size() / stride, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t texel = first; texel < last; ++texel) {
            float* const rgb = &display.values[texel * stride];
            const glm::vec3 codes = tone_curve(exposure * glm::vec3(rgb[0], rgb[1], rgb[2]));
            std::copy_n(&codes[0], 3, rgb);
        }
    });
    return display;
}

Image tone_map(const Image& linear)
{
    return tone_map(linear, choose_exposure(linear).value_or(1.0f));
}

}  // namespace lumel
