#pragma once

#include <cstddef>
#include <numeric>
#include <span>

namespace lumel {

/// Σ a_k b_k, for spans of equal length.
inline double dot(std::span<const float> a, std::span<const float> b)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += double(a[k]) * double(b[k]);
    return sum;
}

inline double dot(std::span<const double> a, std::span<const double> b)
{
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace lumel
