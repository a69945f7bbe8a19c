#ifndef LUMEL_SOLVE_MATRIX_TILES_SHARED_H
#define LUMEL_SOLVE_MATRIX_TILES_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kCluster = 64u;    ///< patches that share a basis
LUMEL_CONST uint kTile = 4u;        ///< side of a tile of coefficients
LUMEL_CONST uint kPrecisions = 3u;  ///< kinds of tiles: codes of 4, 8 and 16 bits

/// What the codes are divided by; they go as far below 0.
LUMEL_CONST float kCodes4 = 7.0f, kCodes8 = 127.0f, kCodes16 = 32767.0f;

/// Light of all channels, red against blue, green against both: orthonormal, so that errors of axes
/// add up like those of channels. Channel c of a matrix is Σ axis[c] T_axis.
LUMEL_CONST vec3 kGrayAxis = vec3(0.57735027f, 0.57735027f, 0.57735027f);
LUMEL_CONST vec3 kRedBlueAxis = vec3(0.70710678f, 0.0f, -0.70710678f);
LUMEL_CONST vec3 kGreenAxis = vec3(0.40824829f, -0.81649658f, 0.40824829f);

LUMEL_SHARED_END
#endif
