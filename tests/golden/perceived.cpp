#include "perceived.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lumel::test {
namespace {

constexpr double kBlur = 1.0;  // standard deviation [pixels]
constexpr int kReach = 3;      // of the blur's kernel [pixels]

using Xyz = std::array<double, 3>;

double linear(int code)
{
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// By the white of sRGB, D65.
Xyz xyz_of(const Colour& colour)
{
    const double r = linear(colour[0]), g = linear(colour[1]), b = linear(colour[2]);
    return {(0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505, 0.2126 * r + 0.7152 * g + 0.0722 * b,
            (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.0890};
}

Xyz lab_of(const Xyz& xyz)
{
    const auto root = [](double t) {
        constexpr double kDark = 6.0 / 29.0;
        return t > kDark * kDark * kDark ? std::cbrt(t) : t / (3.0 * kDark * kDark) + 4.0 / 29.0;
    };
    const double x = root(xyz[0]), y = root(xyz[1]), z = root(xyz[2]);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// Along one axis; a picture goes on as its last pixel.
std::vector<Xyz> blurred(const std::vector<Xyz>& from, int width, int height, bool across)
{
    std::vector<Xyz> to(from.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Xyz sum{};
            double weights = 0.0;
            for (int k = -kReach; k <= kReach; ++k) {
                const int u = std::clamp(x + (across ? k : 0), 0, width - 1),
                          v = std::clamp(y + (across ? 0 : k), 0, height - 1);
                const double weight = std::exp(-0.5 * k * k / (kBlur * kBlur));
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += weight * from[std::size_t(v * width + u)][c];
                weights += weight;
            }
            for (std::size_t c = 0; c < 3; ++c)
                to[std::size_t(y * width + x)][c] = sum[c] / weights;
        }
    return to;
}

std::vector<Xyz> seen(const Picture& picture)
{
    std::vector<Xyz> colours;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            colours.push_back(xyz_of(picture.at(x, y)));
    colours = blurred(colours, picture.width, picture.height, true);
    colours = blurred(colours, picture.width, picture.height, false);
    for (Xyz& colour : colours)
        colour = lab_of(colour);
    return colours;
}

}  // namespace

std::vector<float> perceived_difference(const Picture& a, const Picture& b)
{
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    const std::vector<Xyz> one = seen(a), other = seen(b);
    std::vector<float> difference;
    for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
        double square = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            square += std::pow(one[i][c] - other[i][c], 2);
        difference.push_back(float(std::sqrt(square)));
    }
    return difference;
}

Perceived summary_of(std::vector<float> difference)
{
    Perceived summary;
    for (const float one : difference)
        summary.mean += double(one) / double(difference.size());
    const auto high = difference.begin() + std::ptrdiff_t(0.99 * double(difference.size()));
    std::nth_element(difference.begin(), high, difference.end());
    summary.high = double(*high);
    return summary;
}

}  // namespace lumel::test
