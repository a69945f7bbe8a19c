#pragma once
// PNG files as tests look at them.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

namespace lumel::test {

using Colour = std::array<int, 3>;

struct Picture {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;

    Colour at(int x, int y) const
    {
        const std::size_t first = 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
        return {rgb[first], rgb[first + 1], rgb[first + 2]};
    }
    double mean() const
    {
        double sum = 0.0;
        for (const unsigned char one : rgb)
            sum += one;
        return sum / double(rgb.size());
    }
    int most() const { return *std::max_element(rgb.begin(), rgb.end()); }
};

inline Picture read_picture(const std::string& path)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&image, path.c_str())) << path;
    image.format = PNG_FORMAT_RGB;
    Picture picture{int(image.width), int(image.height),
                    std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr));
    return picture;
}

/// Largest difference of two pictures' colours, and the mean one.
struct Difference {
    int most = 0;
    double mean = 0.0;
};

inline Difference difference(const Picture& a, const Picture& b)
{
    Difference result;
    EXPECT_EQ(a.rgb.size(), b.rgb.size());
    for (std::size_t i = 0; i < std::min(a.rgb.size(), b.rgb.size()); ++i) {
        const int apart = std::abs(int(a.rgb[i]) - int(b.rgb[i]));
        result.most = std::max(result.most, apart);
        result.mean += double(apart) / double(a.rgb.size());
    }
    return result;
}

}  // namespace lumel::test
