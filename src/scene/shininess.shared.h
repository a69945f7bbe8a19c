#ifndef LUMEL_SCENE_SHININESS_SHARED_H
#define LUMEL_SCENE_SHININESS_SHARED_H
#include "core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST float kMostShininess = 1000.0f;  ///< of a lobe's exponent; the least is 1

LUMEL_SHARED_END
#endif
