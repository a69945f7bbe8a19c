#pragma once
// Gauss-Legendre quadrature.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lumel {

struct GaussPoint {
    float position;  ///< 0…1
    float weight;    ///< weights sum to 1
};

/// The rule with `count` ≥ 1 points on [0, 1], exact for polynomials of degree 2 count - 1.
inline std::vector<GaussPoint> gauss_legendre(int count)
{
    std::vector<GaussPoint> rule;
    for (int k = 0; k < count; ++k) {
        // Newton's method on the Legendre polynomial, from the usual initial value.
        double x = -std::cos(std::numbers::pi * (k + 0.75) / (count + 0.5)), slope = 1.0;
        for (int step = 0; step < 8; ++step) {
            double before = 0.0, value = 1.0;
            for (int n = 1; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
                before = value;
                value = next;
            }
            slope = count * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        rule.push_back({float(0.5 + 0.5 * x), float(1.0 / ((1.0 - x * x) * slope * slope))});
    }
    return rule;
}

}  // namespace lumel
