#ifndef LUMEL_SCENE_VALUES_SHININESS_SHARED_H
#define LUMEL_SCENE_VALUES_SHININESS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST float kMaxShininess = 1000.0f;  ///< maximum lobe exponent; the minimum is 1

LUMEL_SHARED_END
#endif
