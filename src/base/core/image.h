#pragma once
// A float image in memory.

#include <cstddef>
#include <vector>

namespace lumel {

/// Row-major, top row first, `channels` floats per texel: values[(y * width + x) * channels + c].
struct Image {
    int width = 0;
    int height = 0;
    int channels = 4;
    std::vector<float> values;

    Image() = default;
    Image(int w, int h, int c)
        : width(w),
          height(h),
          channels(c),
          values(std::size_t(w) * std::size_t(h) * std::size_t(c))
    {
    }

    float* at(int x, int y)
    {
        return values.data() +
               (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels);
    }
    const float* at(int x, int y) const
    {
        return values.data() +
               (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels);
    }
};

}  // namespace lumel
