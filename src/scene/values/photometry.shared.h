#ifndef LUMEL_SCENE_VALUES_PHOTOMETRY_SHARED_H
#define LUMEL_SCENE_VALUES_PHOTOMETRY_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kPolarSteps = 360u;   ///< Photometry samples over 0…π
LUMEL_CONST uint kAzimuthSteps = 72u;  ///< over 0…2π

/// Minimum difference of the cosines of a spot's two cones: KHR_lights_punctual's guard against a
/// division by zero.
LUMEL_CONST float kMinConeStep = 0.001f;

LUMEL_SHARED_END
#endif
