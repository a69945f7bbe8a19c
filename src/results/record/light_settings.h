#pragma once
// The lights that the command line adds to a scene, as a report has them.

#include <string>

#include "base/json/json_view.h"
#include "scene/sky/light_options.h"

namespace lumel {

/// Named as the options are; what was left alone is left out. Angles in degrees, in as few digits
/// as give the angle back; files by their absolute paths, so that they are found from any folder.
Json light_settings(const LightOptions& options);

/// Inverse of light_settings(). folder: that paths which are relative begin at. Throws Error{input}
/// with the place of what is wrong.
LightOptions light_options_of(const JsonView& settings, const std::string& folder);

/// Throws Error{input} if a file of a bake's lights is not there any more.
void check_light_files(const LightOptions& options);

}  // namespace lumel
