#ifndef LUMEL_METHODS_GLOSSY_PHONG_SHARED_H
#define LUMEL_METHODS_GLOSSY_PHONG_SHARED_H
#include "atlas/packing/lumel.shared.h"
LUMEL_SHARED_BEGIN

// The table of the lobe's albedo: a row per exponent, log n = 0…log kMaxShininess, a column per
// cosine, cosθ = 0…1, and one more column for the mean over diffuse incoming light.
LUMEL_CONST uint kAlbedoCosines = 64u;
LUMEL_CONST uint kAlbedoExponents = 32u;

LUMEL_SHARED_END
#endif
