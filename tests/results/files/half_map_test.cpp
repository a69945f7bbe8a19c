// A lamp's map at half its size, decoded as the page's viewer does.

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "results/files/half_map.h"

namespace lumel {
namespace {

constexpr glm::vec3 kRec709{0.2126f, 0.7152f, 0.0722f};

/// Codes of a plane from differences; high: upper bytes, or null.
std::vector<int> decoded_plane(const HalfMap& map, const std::uint8_t* low,
                               const std::uint8_t* high)
{
    const auto width = std::size_t(map.width);
    std::vector<int> codes(width * std::size_t(map.height));
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const std::size_t x = i % width, y = i / width;
        const int left = x > 0 ? codes[i - 1] : y > 0 ? codes[i - width] : 0;
        const int above = y > 0 ? codes[i - width] : left;
        const int corner = x > 0 && y > 0 ? codes[i - width - 1] : above;
        const auto [least, most] = std::minmax(left, above);
        const int word = low[i] + (high ? 256 * high[i] : 0);
        const int difference = word % 2 ? -(word + 1) / 2 : word / 2;
        codes[i] =
            (std::clamp(left + above - corner, least, most) + difference) & (high ? 0xffff : 0xff);
    }
    return codes;
}

std::vector<glm::vec3> decoded(const HalfMap& map)
{
    const std::size_t count = std::size_t(map.width) * std::size_t(map.height);
    EXPECT_EQ(map.bytes.size(), 4 * count);
    const std::uint8_t* plane = map.bytes.data();
    const std::vector<int> codes = decoded_plane(map, plane, plane + count),
                           reds = decoded_plane(map, plane + 2 * count, nullptr),
                           blues = decoded_plane(map, plane + 3 * count, nullptr);
    std::vector<glm::vec3> light(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (codes[i] == 0)
            continue;
        const float lux = map.brightest * std::exp2(float(codes[i] - 4095) / 256.0f);
        const float red = float(reds[i]) / 255.0f, blue = float(blues[i]) / 255.0f;
        const glm::vec3 parts(red * red, 1.0f - red * red - blue * blue, blue * blue);
        light[i] = lux * parts / kRec709;
    }
    return light;
}

/// A lit map with a gutter: the left half is covered, and the rest is black.
Image half_covered(int width, int height)
{
    Image map(width, height, 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2; ++x) {
            const float light = 100.0f + 40.0f * std::sin(0.3f * float(x)) + 10.0f * float(y % 7);
            const glm::vec4 texel(light, 0.8f * light, 0.4f * light, 1.0f);
            std::copy_n(&texel.x, 4, map.at(x, y));
        }
    return map;
}

TEST(HalfMap, KeepsIlluminanceToAThousandthAndColoursToAHundredth)
{
    const Image map = half_covered(40, 20);
    const HalfMap half = half_map(map);
    ASSERT_EQ(half.width, 20);
    ASSERT_EQ(half.height, 10);
    const std::vector<glm::vec3> light = decoded(half);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width / 2; ++x) {
            glm::vec3 mean(0.0f);
            for (int i = 0; i < 4; ++i) {
                const float* texel = map.at(2 * x + i % 2, 2 * y + i / 2);
                mean += glm::vec3(texel[0], texel[1], texel[2]) / 4.0f;
            }
            const glm::vec3 found = light[std::size_t(y * half.width + x)];
            EXPECT_NEAR(glm::dot(found, kRec709) / glm::dot(mean, kRec709), 1.0f, 2e-3f);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c] / mean[c], 1.0f, 0.02f) << x << ", " << y << ", " << c;
        }
}

TEST(HalfMap, BlackGuttersDoNotDarkenTheRimOfAChart)
{
    // 21 covered columns: the last texel at half the size has one of two columns.
    Image map(64, 8, 4);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < 21; ++x)
            std::fill_n(map.at(x, y), 4, 1.0f);
    const HalfMap half = half_map(map);
    const std::vector<glm::vec3> light = decoded(half);
    EXPECT_NEAR(light[10].g, 1.0f, 0.01f);
    EXPECT_EQ(light[11].g, 0.0f);
}

TEST(HalfMap, HoldsMapsOfOddSizesAndLampsThatLightNothing)
{
    const HalfMap odd = half_map(Image(7, 5, 4));
    EXPECT_EQ(odd.width, 4);
    EXPECT_EQ(odd.height, 3);
    EXPECT_EQ(odd.brightest, 0.0f);
    for (const glm::vec3& light : decoded(odd))
        EXPECT_EQ(light, glm::vec3(0.0f));
}

}  // namespace
}  // namespace lumel
