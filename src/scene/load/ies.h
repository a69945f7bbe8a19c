#pragma once
// Photometric files of luminaires: IES LM-63.

#include <string>

#include "base/core/files.h"
#include "scene/values/scene.h"

namespace lumel {

/// Reads LM-63 of 1986, 1991, 1995, 2002 or 2019 with photometry of type C. Candela are those of
/// the file times its multiplier and ballast factor; tables for tilted lamps are passed over, and
/// so is the size of the luminaire. The profile's nadir is the light's -z, its horizontal angle 0
/// the light's +x. `place` names the file in messages.
/// Throws Error{input} with the line of what is wrong.
Photometry read_ies(const Bytes& bytes, const std::string& place, const std::string& name);

}  // namespace lumel
