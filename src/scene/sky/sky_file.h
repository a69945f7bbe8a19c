#pragma once
// Skies from image files, and turned.

#include <string>

#include "scene/values/sky.h"

namespace lumel {

/// Reads a latitude-longitude image of radiance: OpenEXR (.exr) or Radiance (.hdr), as linear RGB
/// in cd/m². What is negative or not a number becomes 0, what is infinite the largest half.
/// Throws Error{input}.
Sky read_sky(const std::string& path);

/// The same sky turned about +y, counter-clockwise as seen from above, by an angle [rad]. Every
/// row keeps its light.
Sky turned(const Sky& sky, double angle);

}  // namespace lumel
