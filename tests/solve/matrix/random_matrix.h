#pragma once
// Matrices to compress, like those of rooms: positive, a few large entries in each row.

#include <cmath>
#include <random>

#include "solve/matrix/color_matrix.h"

namespace lumel {

/// Falls with the distance between places on a line, which a shuffle has mixed up.
inline ColorMatrix shuffled_kernel(std::uint32_t n, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<float> place(n);
    for (float& x : place)
        x = std::uniform_real_distribution<float>(0.0f, 10.0f)(random);
    ColorMatrix matrix;
    for (int c = 0; c < 3; ++c) {
        matrix.channel[c] = {n, std::vector<float>(std::size_t(n) * n)};
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const float distance = place[i] - place[j];
                matrix.channel[c].values[i * n + j] =
                    i == j ? 0.0f
                           : (0.5f + 0.1f * float(c)) / (0.1f + distance * distance) / float(n);
            }
    }
    return matrix;
}

/// Of all entries of all channels.
inline double squared_difference(const ColorMatrix& a, const ColorMatrix& b)
{
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < a.channel[c].values.size(); ++i)
            sum += std::pow(double(a.channel[c].values[i]) - double(b.channel[c].values[i]), 2);
    return sum;
}

}  // namespace lumel
