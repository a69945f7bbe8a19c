#include "truth/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/core/error.h"

namespace lumel {

namespace {

/// ε of the relative mean squared error, relative to the mean reference.
constexpr double kRelativeFloor = 0.01;

double brightest(const Image& image, std::size_t texel)
{
    const float* value = &image.values[texel * image.channels];
    return *std::max_element(value, value + std::min(3, image.channels));
}

bool covered(const Image& image, std::size_t texel)
{
    return image.channels < 4 || image.values[texel * image.channels + 3] > 0.0f;
}

void check_sizes(const Image& map, const Image& reference)
{
    if (map.width == reference.width && map.height == reference.height)
        return;
    const auto size = [](const Image& image) {
        return std::to_string(image.width) + " x " + std::to_string(image.height);
    };
    throw Error(ErrorKind::input, "",
                "the maps differ in size, " + size(map) + " and " + size(reference) +
                    " texels; bake both with the same atlas");
}

/// Colour channels of the texels that both maps cover.
struct Pairs {
    std::vector<double> difference;  ///< d; infinite where either value is not finite
    std::vector<double> reference;
    double mean_reference = 0.0;
    std::size_t texels = 0;
};

Pairs pair_up(const Image& map, const Image& reference,
              double most = std::numeric_limits<double>::infinity())
{
    check_sizes(map, reference);
    const int channels = std::min({3, map.channels, reference.channels});
    Pairs pairs;
    double sum = 0.0;
    for (std::size_t texel = 0; texel < std::size_t(map.width) * map.height; ++texel) {
        if (!covered(map, texel) || !covered(reference, texel) ||
            brightest(reference, texel) > most)
            continue;
        ++pairs.texels;
        for (int c = 0; c < channels; ++c) {
            const double value = map.values[texel * map.channels + c];
            const double truth = reference.values[texel * reference.channels + c];
            const double d = value - truth;
            pairs.difference.push_back(std::isfinite(d) ? d
                                                        : std::numeric_limits<double>::infinity());
            pairs.reference.push_back(truth);
            sum += truth;
        }
    }
    if (pairs.texels == 0)
        throw Error(ErrorKind::input, "", "no texel is covered in both maps");
    pairs.mean_reference = sum / double(pairs.reference.size());
    return pairs;
}

/// value / mean, where 0 / 0 is 0.
double relative(double value, double mean)
{
    return value == 0.0 ? 0.0 : value / mean;
}

/// Black, blue, red, yellow, white, with increasing lightness.
std::array<float, 3> heat(double level)
{
    constexpr std::array<std::array<float, 3>, 5> kStops{{{0.0f, 0.0f, 0.0f},
                                                          {0.10f, 0.15f, 0.75f},
                                                          {0.85f, 0.15f, 0.15f},
                                                          {1.0f, 0.85f, 0.10f},
                                                          {1.0f, 1.0f, 1.0f}}};
    const double place = std::clamp(level, 0.0, 1.0) * double(kStops.size() - 1);
    const std::size_t below = std::min(std::size_t(place), kStops.size() - 2);
    const float rest = float(place - double(below));
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = kStops[below][c] + rest * (kStops[below + 1][c] - kStops[below][c]);
    return color;
}

}  // namespace

bool covers_the_same(const Image& map, const Image& reference)
{
    if (map.width != reference.width || map.height != reference.height)
        return false;
    for (std::size_t texel = 0; texel < std::size_t(map.width) * map.height; ++texel)
        if (covered(map, texel) != covered(reference, texel))
            return false;
    return true;
}

MapError compare_maps(const Image& map, const Image& reference, double most)
{
    const Pairs pairs = pair_up(map, reference, most);
    const double mean = pairs.mean_reference;
    const double floor = kRelativeFloor * mean;
    const double count = double(pairs.difference.size());

    double sum = 0.0, squares = 0.0, relative_squares = 0.0;
    std::vector<double> sizes;
    sizes.reserve(pairs.difference.size());
    for (std::size_t i = 0; i < pairs.difference.size(); ++i) {
        const double d = pairs.difference[i], truth = pairs.reference[i];
        sum += d;
        squares += d * d;
        relative_squares += relative(d * d, truth * truth + floor * floor);
        sizes.push_back(std::abs(d));
    }
    const auto p95 = sizes.begin() + std::ptrdiff_t(0.95 * (count - 1.0) + 0.5);
    std::nth_element(sizes.begin(), p95, sizes.end());

    MapError error;
    error.relative_rmse = relative(std::sqrt(squares / count), mean);
    const auto [least, largest] =
        std::minmax_element(pairs.reference.begin(), pairs.reference.end());
    error.normalized_rmse = relative(std::sqrt(squares / count), *largest - *least);
    error.rel_mse = relative_squares / count;
    error.bias = relative(sum / count, mean);
    error.p95 = relative(*p95, mean);
    error.max = relative(*std::max_element(sizes.begin(), sizes.end()), mean);
    error.texels = pairs.texels;
    return error;
}

Image heat_map(const Image& map, const Image& reference, double full_scale)
{
    const Pairs pairs = pair_up(map, reference);
    const std::size_t channels = pairs.difference.size() / pairs.texels;
    Image picture(map.width, map.height, 4);
    std::size_t next = 0;
    for (std::size_t texel = 0; texel < std::size_t(map.width) * map.height; ++texel) {
        if (!covered(map, texel) || !covered(reference, texel))
            continue;
        double squares = 0.0;
        for (std::size_t c = 0; c < channels; ++c) {
            const double d = pairs.difference[next++];
            squares += d * d;
        }
        const double size = std::sqrt(squares / double(channels));
        const auto color = heat(relative(size, pairs.mean_reference) / full_scale);
        std::copy(color.begin(), color.end(), picture.values.begin() + std::ptrdiff_t(texel * 4));
        picture.values[texel * 4 + 3] = 1.0f;
    }
    return picture;
}

}  // namespace lumel
