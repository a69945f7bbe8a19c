#pragma once
// What is seen where no surface is.

#include "base/core/image.h"
#include "scene/values/sky.h"
#include "scene/values/view.h"

namespace lumel {

/// Puts the sky behind a picture, which is opaque then; without a sky does nothing. picture:
/// display codes, RGBA, alpha the share of a pixel that surfaces cover. exposure: that of
/// tone_map(). Shows no sun disc of a lamp.
void put_sky_behind(Image& picture, const Sky& sky, const View& view, float exposure);

}  // namespace lumel
