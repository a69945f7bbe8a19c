// Form factor of a polygon from a point.
//
// [Lam60] J. H. Lambert, Photometria, 1760. For a polygon with corners c_k, from x with normal n,
// with a_k = c_k - x:
//
//     F = 1/2π Σ_k θ_k n·(a_k+1 × a_k) / |a_k+1 × a_k|,    θ_k = angle between a_k and a_k+1
//
// for corners counter-clockwise from x, after clipping at x's horizon.

#include "atlas/near/near_field.h"

#include <cmath>
#include <numbers>

namespace lumel {

namespace {

using dvec3 = glm::dvec3;

/// Maximum tan²θ for the series of the arc tangent: most edges of most near pairs.
constexpr double kSeriesLimit = 0.2;

/// θ / sine from (scaled) sine² and cosine of an angle; 0 for an edge without direction.
double angle_over_sine(double sine2, double cosine)
{
    if (cosine > 0.0 && sine2 < kSeriesLimit * cosine * cosine) {
        // atan(t) / t = 1 - t²/3 + t⁴/5 - …, to 1e-8 at the limit.
        const double t2 = sine2 / (cosine * cosine);
        double sum = 0.0;
        for (int n = 9; n >= 0; --n)
            sum = 1.0 / (2 * n + 1) - t2 * sum;
        return sum / cosine;
    }
    const double sine = std::sqrt(sine2);
    return sine > 0.0 ? std::atan2(sine, cosine) / sine : 0.0;
}

/// Term θ n·Γ of an edge from a to b, both relative to the receiver.
double edge_term(const dvec3& n, const dvec3& a, const dvec3& b)
{
    const dvec3 across = glm::cross(b, a);
    return angle_over_sine(glm::dot(across, across), glm::dot(a, b)) * glm::dot(n, across);
}

}  // namespace

float signed_form_factor(const glm::vec3& x, const glm::vec3& n, const glm::vec3* corners,
                         int count)
{
    const dvec3 normal(n), origin(x);
    dvec3 previous = dvec3(corners[count - 1]) - origin;
    double above_previous = glm::dot(normal, previous);
    double sum = 0.0;

    // Traverses the polygon; closes the gap of a part below the horizon.
    dvec3 leaves(0.0), returns(0.0);
    bool cut = false;
    for (int k = 0; k < count; ++k) {
        const dvec3 corner = dvec3(corners[k]) - origin;
        const double above = glm::dot(normal, corner);
        if (above > 0.0 || above_previous > 0.0) {
            dvec3 a = previous, b = corner;
            if (above <= 0.0) {
                b = a + (corner - a) * (above_previous / (above_previous - above));
                leaves = b;
                cut = true;
            } else if (above_previous <= 0.0) {
                a = b + (previous - b) * (above / (above - above_previous));
                returns = a;
                cut = true;
            }
            sum += edge_term(normal, a, b);
        }
        previous = corner;
        above_previous = above;
    }
    if (cut)
        sum += edge_term(normal, leaves, returns);
    return float(sum * (0.5 / std::numbers::pi));
}

}  // namespace lumel
