#pragma once
// Where the sun stands.

#include <string>

#include <glm/glm.hpp>

namespace lumel {

/// Place of the sun as an observer sees it.
struct SunPosition {
    double azimuth = 0.0;    ///< [rad] clockwise from north as seen from above: east is π/2
    double elevation = 0.0;  ///< [rad] above the horizon, without refraction
};

/// Seconds since 2000-01-01 12:00 UTC of "YYYY-MM-DDThh:mm[:ss]" with "Z", an offset such as
/// "+02:00" or nothing, which is UTC: the ISO 8601 form. Throws Error{input} for anything else.
double seconds_since_2000(const std::string& date_time);

/// [AA] seen from a place: latitude [rad] grows northwards, longitude [rad] eastwards. Within
/// 0.02° from 1950 to 2050.
SunPosition sun_position(double latitude, double longitude, double seconds_since_2000);

/// Unit direction towards it. North is -z, east +x, up +y.
glm::vec3 direction_of(const SunPosition& sun);

}  // namespace lumel
