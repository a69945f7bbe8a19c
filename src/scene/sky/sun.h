#pragma once
// Position of the sun.

#include <string>

#include <glm/glm.hpp>

namespace lumel {

/// Direction of the sun from an observer.
struct SunPosition {
    double azimuth = 0.0;    ///< [rad] clockwise from north, from above: east is π/2
    double elevation = 0.0;  ///< [rad] above the horizon, without refraction
};

/// Seconds since 2000-01-01 12:00 UTC of "YYYY-MM-DDThh:mm[:ss]" (ISO 8601) with "Z", an offset
/// such as "+02:00" or nothing, meaning UTC. Throws Error{input} for other texts.
double seconds_since_2000(const std::string& date_time);

/// Position according to [AA], for a latitude [rad] (north positive) and longitude [rad] (east
/// positive). Accurate to 0.02° from 1950 to 2050.
SunPosition sun_position(double latitude, double longitude, double seconds_since_2000);

/// Unit direction to the sun. North is -z, east +x, up +y.
glm::vec3 direction_of(const SunPosition& sun);

}  // namespace lumel
