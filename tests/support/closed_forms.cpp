#include "closed_forms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lumel {

namespace {

constexpr double kPi = std::numbers::pi;

double squared(double x)
{
    return x * x;
}

/// B-3: to the rectangle from the point's axis to (x, y); odd in both. [How]
double parallel_corner(double x, double y, double distance)
{
    const double A = x / distance, B = y / distance;
    const double root_a = std::sqrt(1.0 + A * A), root_b = std::sqrt(1.0 + B * B);
    return (A / root_a * std::atan(B / root_a) + B / root_b * std::atan(A / root_b)) / (2.0 * kPi);
}

/// B-4: to the wall from its foot to (x, z); odd in x, even in z. [How]
double perpendicular_corner(double x, double z, double distance)
{
    const double root = std::hypot(distance, z);
    return (std::atan(x / distance) - distance / root * std::atan(x / root)) / (2.0 * kPi);
}

}  // namespace

double point_to_parallel_rectangle(const Span& x, const Span& y, double distance)
{
    return parallel_corner(x.high, y.high, distance) - parallel_corner(x.low, y.high, distance) -
           parallel_corner(x.high, y.low, distance) + parallel_corner(x.low, y.low, distance);
}

double point_to_perpendicular_rectangle(const Span& x, const Span& z, double distance)
{
    const double low = std::max(z.low, 0.0), high = std::max(z.high, 0.0);
    return perpendicular_corner(x.high, high, distance) -
           perpendicular_corner(x.low, high, distance) -
           perpendicular_corner(x.high, low, distance) + perpendicular_corner(x.low, low, distance);
}

double point_to_coaxial_disc(double radius, double distance)
{
    return squared(radius) / (squared(radius) + squared(distance));
}

double opposed_rectangles(double a, double b, double distance)
{
    const double X = a / distance, Y = b / distance;
    const double root_x = std::sqrt(1.0 + X * X), root_y = std::sqrt(1.0 + Y * Y);
    const double logarithm = 0.5 * std::log((1.0 + X * X) * (1.0 + Y * Y) / (1.0 + X * X + Y * Y));
    return 2.0 / (kPi * X * Y) *
           (logarithm + X * root_y * std::atan(X / root_y) + Y * root_x * std::atan(Y / root_x) -
            X * std::atan(X) - Y * std::atan(Y));
}

double adjoined_rectangles(double width, double height, double edge)
{
    const double W = width / edge, H = height / edge;
    const double W2 = W * W, H2 = H * H, S = W2 + H2;
    const double logarithm = std::log((1.0 + W2) * (1.0 + H2) / (1.0 + S)) +
                             W2 * std::log(W2 * (1.0 + S) / ((1.0 + W2) * S)) +
                             H2 * std::log(H2 * (1.0 + S) / ((1.0 + H2) * S));
    return (W * std::atan(1.0 / W) + H * std::atan(1.0 / H) -
            std::sqrt(S) * std::atan(1.0 / std::sqrt(S)) + 0.25 * logarithm) /
           (kPi * W);
}

double coaxial_discs(double from, double to, double distance)
{
    const double R1 = from / distance, R2 = to / distance;
    const double X = 1.0 + (1.0 + R2 * R2) / (R1 * R1);
    return 0.5 * (X - std::sqrt(X * X - 4.0 * squared(to / from)));
}

double furnace_irradiance(double mean_emission, double mean_albedo)
{
    return mean_emission / (1.0 - mean_albedo);
}

}  // namespace lumel
