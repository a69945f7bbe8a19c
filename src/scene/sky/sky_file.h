#pragma once
// Skies from image files, and their rotation.

#include <string>

#include "scene/values/sky.h"

namespace lumel {

/// True for names of images that read_sky() reads: *.exr and *.hdr.
bool is_sky_file(const std::string& path);

/// Reads a latitude-longitude image of radiance: OpenEXR (.exr) or Radiance (.hdr), as linear RGB
/// in cd/m². Negative values and NaN become 0, infinity the largest half. Throws Error{input}.
Sky read_sky(const std::string& path);

/// The sky rotated about +y, counter-clockwise from above, by an angle [rad]. Preserves the
/// light of each row.
Sky turned(const Sky& sky, double angle);

}  // namespace lumel
