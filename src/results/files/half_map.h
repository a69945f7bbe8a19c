#pragma once
// A lamp's lightmap at half its size, as bytes that gzip shortens well.

#include <cstdint>
#include <vector>

#include "base/core/image.h"

namespace lumel {

/// Irradiance of a lamp for addons/three/half_map.js. A texel has a code of its illuminance Y,
///     Y = brightest 2^((code - 4095) / 256),  0: none,
/// and two of the shares of red and blue in it: 0.2126 R / Y = (code / 255)², 0.0722 B / Y
/// likewise. Codes are stored as differences from a prediction by the texels to the left and above.
struct HalfMap {
    int width = 0, height = 0;
    float brightest = 0.0f;  ///< largest illuminance [lx]
    /// Four planes [height][width]: low and high bytes of the first code, then the other two.
    std::vector<std::uint8_t> bytes;
};

/// map: RGB irradiance [lx] with coverage in alpha; its gutters are filled. Half-size texels
/// average covered texels only, so light of other charts does not bleed in.
HalfMap half_map(const Image& map);

}  // namespace lumel
