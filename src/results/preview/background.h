#pragma once
// The sky in pictures.

#include "base/core/image.h"
#include "scene/values/sky.h"
#include "scene/values/view.h"

namespace lumel {

/// Puts the sky behind a picture, which is opaque then; without a sky does nothing. Directional
/// lights, such as the sun, are not drawn. picture: display codes, RGBA, alpha the share of a pixel
/// that surfaces cover. exposure: that of tone_map().
void put_sky_behind(Image& picture, const Sky& sky, const View& view, float exposure);

}  // namespace lumel
