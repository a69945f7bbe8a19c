#pragma once
// Photometric files of luminaires: IES LM-63.

#include <string>

#include "base/core/files.h"
#include "scene/values/scene.h"

namespace lumel {

/// Reads LM-63 of 1986, 1991, 1995, 2002 or 2019 with photometry of type C. Candela are multiplied
/// by the file's multiplier and ballast factor; tilt tables and luminaire sizes are ignored. The
/// profile's nadir is the light's -z, its horizontal angle 0 the light's +x. `place` names the file
/// in messages. Throws Error{input} with the faulty line.
Photometry read_ies(const Bytes& bytes, const std::string& place, const std::string& name);

}  // namespace lumel
