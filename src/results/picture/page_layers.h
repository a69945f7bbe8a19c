#pragma once
// Images of lamps whose light adds up in a browser.

#include <cstdint>

#include "base/core/image.h"

namespace lumel {

/// The layer of a lamp. CSS blends codes 0…1, not light: mix-blend-mode `screen` makes
/// 1 - (1 - a)(1 - b) of two. So the layer of the exposed radiance x has
///
///     n = 1 - exp(-k x),
///
/// and layers with `screen`, upon black, have 1 - exp(-k Σ x): the sum of light, with a shoulder.
/// White with `soft-light` above them shows its square root, for n >= 1/4, and
/// ((16 n - 12) n + 4) n below. That is close to the tone curve of PNGs; k makes them equal for mid
/// grey. Codes are dithered, all channels alike and layers of other numbers otherwise: rounded,
/// dark layers would show steps and colours. radiance [cd/m²], RGBA; exposure [m²/cd]. Opaque.
Image page_layer(const Image& radiance, float exposure, std::uint32_t number);

}  // namespace lumel
