#pragma once
// Closed-form form factors and radiosity.
//
// [How] J. Howell, A Catalog of Radiation Heat Transfer Configuration Factors; C-11, C-14, C-41,
//       B-3 and B-4 are its numbers.
//
// Solvers compute form factors of polygons by Lambert's edge sum (atlas/near/form_factor.cpp), and
// are tested against these.
//
// A uniform plate of emission E lights a point or area by H = E F, with F its form factor to the
// plate.

namespace lumel {

/// A span along an axis [m], low ≤ high.
struct Span {
    double low = 0.0;
    double high = 0.0;
};

/// Point form factor: from the origin, facing +z, to the rectangle x × y in the plane z = distance
/// > 0. Signed sum of B-3 over its corners. [How]
double point_to_parallel_rectangle(const Span& x, const Span& y, double distance);

/// Point form factor: from the origin, facing +z, to the rectangle x × z in the plane y = distance
/// > 0, clipped to z > 0. Signed sum of B-4 over its corners. [How]
double point_to_perpendicular_rectangle(const Span& x, const Span& z, double distance);

/// Point form factor to a parallel disc whose axis contains the point. [How]
double point_to_coaxial_disc(double radius, double distance);

/// C-11: between equal, directly opposed rectangles a × b at `distance`. [How]
double opposed_rectangles(double a, double b, double distance);

/// C-14: from a rectangle width × edge to one of height × edge, at a right angle along their common
/// edge. [How]
double adjoined_rectangles(double width, double height, double edge);

/// C-41: from a disc of radius `from` to a coaxial parallel one of radius `to`. [How]
double coaxial_discs(double from, double to, double distance);

/// Irradiance H in a closed room of uniform emission E and albedo ρ < 1: E / (1 - ρ). In a sphere
/// also for varying E and ρ, given their area averages.
double furnace_irradiance(double mean_emission, double mean_albedo);

}  // namespace lumel
