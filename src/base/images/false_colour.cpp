#include "base/images/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "base/images/digits.h"

namespace lumel {
namespace {

/// sRGB colours, as in page/viewer/colours.js.
constexpr std::array<std::array<float, 3>, 7> kAnchors = {{{38, 16, 82},
                                                           {46, 62, 140},
                                                           {32, 108, 142},
                                                           {30, 152, 138},
                                                           {74, 194, 109},
                                                           {166, 219, 53},
                                                           {253, 231, 37}}};
constexpr float kMaxCode = 255.0f;
constexpr std::array<double, 3> kSteps = {1.0, 2.0, 5.0};  ///< ticks per decade
constexpr double kRounding = 1e-3;  ///< relative tolerance for ticks at the ends
constexpr double kLowShare = 0.02,
                 kHighShare = 0.995;                 ///< percentiles at the ends
constexpr double kMaxRange = 1e4, kMinRange = 10.0;  ///< high / low

constexpr glm::vec3 kPaper{1.0f}, kInk{0.1f}, kNothing{0.55f};

// The legend [pixels].
constexpr int kMargin = 12, kBarWidth = 20, kTickLength = 5, kTextScale = 2;
constexpr int kLegendWidth = 120;  ///< margins, bar, tick and six digits
constexpr int kMinHeight = 240;    ///< fits the numbers of four decades

/// The next larger 1, 2 or 5 times a power of ten.
double rounded_up(double lux)
{
    const double decade = std::pow(10.0, std::floor(std::log10(lux)));
    for (const double step : kSteps)
        if (step * decade >= lux * (1.0 - kRounding))
            return step * decade;
    return 10.0 * decade;
}

void paint(Image& image, int x, int y, const glm::vec3& color)
{
    for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = color[c];
}

/// Draws the bar, high values on top, with a tick and a number for each of the scale's ticks.
void draw_legend(Image& image, int left, const LuxScale& scale, std::string_view name)
{
    const glm::ivec2 unit = text_size(name, kTextScale);
    const int top = kMargin + 2 * unit.y, bottom = image.height - kMargin - unit.y / 2;
    const int bar = left + kMargin, ticks = bar + kBarWidth;
    draw_text(image, {bar, kMargin}, name, kTextScale, kInk);
    const auto place_of_row = [&](int y) { return double(bottom - y) / double(bottom - top); };
    for (int y = top; y <= bottom; ++y)
        for (int x = bar; x < ticks; ++x)
            paint(image, x, y, scale_color(place_of_row(y)));
    int last = image.height;
    for (const double lux : scale.ticks()) {
        const int y = bottom - int(std::lround(scale.place_of(lux) * (bottom - top)));
        for (int x = ticks; x < ticks + kTickLength; ++x)
            paint(image, x, y, kInk);
        if (last - y < unit.y + kTextScale)  // no space beside the number below
            continue;
        last = y;
        draw_text(image, {ticks + kTickLength + 2 * kTextScale, y - unit.y / 2}, tick_text(lux),
                  kTextScale, kInk);
    }
}

}  // namespace

double LuxScale::place_of(double lux) const
{
    constexpr double kDark = 1e-9;  // [lx] lower limit for the logarithm
    return std::log(std::max(lux, kDark) / low) / std::log(high / low);
}

double LuxScale::lux_at(double place) const
{
    return low * std::pow(high / low, place);
}

std::vector<double> LuxScale::ticks() const
{
    std::vector<double> found;
    const int last = int(std::floor(std::log10(high) + kRounding));
    for (int decade = int(std::floor(std::log10(low) - kRounding)); decade <= last; ++decade)
        for (const double step : kSteps) {
            const double lux = step * std::pow(10.0, decade);
            if (lux >= low * (1.0 - kRounding) && lux <= high * (1.0 + kRounding))
                found.push_back(lux);
        }
    return found;
}

LuxScale scale_for(std::span<const float> lux)
{
    std::vector<float> lit;
    std::copy_if(lux.begin(), lux.end(), std::back_inserter(lit),
                 [](float value) { return value > 0.0f; });
    if (lit.empty())
        return {};
    std::sort(lit.begin(), lit.end());
    const auto part = [&](double share) {
        return double(lit[std::size_t(share * double(lit.size() - 1))]);
    };
    const double high = rounded_up(part(kHighShare));
    const double low = std::max(0.5 * rounded_up(part(kLowShare)), high / kMaxRange);
    return {.low = std::min(low, high / kMinRange), .high = high};
}

glm::vec3 scale_color(double place)
{
    const double at = std::clamp(place, 0.0, 1.0) * double(kAnchors.size() - 1);
    const std::size_t low = std::min(std::size_t(at), kAnchors.size() - 2);
    const auto share = float(at - double(low));
    glm::vec3 color;
    for (int c = 0; c < 3; ++c)
        color[c] =
            glm::mix(kAnchors[low][std::size_t(c)], kAnchors[low + 1][std::size_t(c)], share) /
            kMaxCode;
    return color;
}

std::string tick_text(double lux)
{
    std::array<char, 32> text{};
    const int decimals = std::max(0, -int(std::floor(std::log10(lux) + kRounding)));
    std::snprintf(text.data(), text.size(), "%.*f", decimals, lux);
    return text.data();
}

Image colours_of(const Image& lux, const LuxScale& scale)
{
    Image image(lux.width, lux.height, 3);
    for (int y = 0; y < lux.height; ++y)
        for (int x = 0; x < lux.width; ++x) {
            const float value = lux.at(x, y)[0];
            paint(image, x, y, value < 0.0f ? kNothing : scale_color(scale.place_of(value)));
        }
    return image;
}

Image false_colour(const Image& lux, const LuxScale& scale, std::string_view unit)
{
    const Image colours = colours_of(lux, scale);
    Image image(lux.width + kLegendWidth, std::max(lux.height, kMinHeight), 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            paint(image, x, y, kPaper);
    for (int y = 0; y < lux.height; ++y)
        std::copy(colours.at(0, y), colours.at(0, y) + 3 * lux.width, image.at(0, y));
    draw_legend(image, lux.width, scale, unit);
    return image;
}

}  // namespace lumel
