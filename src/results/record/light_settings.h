#pragma once
// Lights that options add to a scene, in a report.

#include <string>

#include "base/json/json_view.h"
#include "scene/sky/light_options.h"

namespace lumel {

/// Named as the options; defaults are omitted. Angles in degrees, with as few digits as convert
/// back exactly; files by absolute paths.
Json light_settings(const LightOptions& options);

/// Inverse of light_settings(). folder: base of relative paths. Throws Error{input} with the
/// location of the error.
LightOptions light_options_of(const JsonView& settings, const std::string& folder);

/// Throws Error{input} if a file of a bake's lights no longer exists.
void check_light_files(const LightOptions& options);

}  // namespace lumel
