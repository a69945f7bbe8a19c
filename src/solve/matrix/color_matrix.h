#pragma once
// Form factors with colours: what one surface does to the light of another, a channel at a time.

#include <array>
#include <cstdint>
#include <vector>

namespace lumel {

/// Row-major [size][size].
struct SquareMatrix {
    std::uint32_t size = 0;
    std::vector<float> values;

    float at(std::uint32_t row, std::uint32_t column) const
    {
        return values[std::size_t(row) * size + column];
    }
};

/// One matrix per colour channel: R, G, B. All have the same size.
struct ColorMatrix {
    std::array<SquareMatrix, 3> channel;

    std::uint32_t size() const { return channel[0].size; }
};

}  // namespace lumel
