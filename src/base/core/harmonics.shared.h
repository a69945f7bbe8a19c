#ifndef LUMEL_BASE_CORE_HARMONICS_SHARED_H
#define LUMEL_BASE_CORE_HARMONICS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

// Constants of the orthonormal real spherical harmonics.
LUMEL_CONST float kY0 = 0.28209479f;   ///< √(1/4π)
LUMEL_CONST float kY1 = 0.48860251f;   ///< √(3/4π)    × y, z, x
LUMEL_CONST float kY2 = 1.09254843f;   ///< √(15/4π)   × xy, yz, xz
LUMEL_CONST float kY20 = 0.31539157f;  ///< √(5/16π)   × 3z² - 1
LUMEL_CONST float kY22 = 0.54627422f;  ///< √(15/16π)  × x² - y²

LUMEL_SHARED_END
#endif
