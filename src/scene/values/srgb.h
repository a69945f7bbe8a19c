#pragma once
// sRGB decoding of textures.

#include <array>
#include <cmath>
#include <cstddef>

namespace lumel {

/// IEC 61966-2-1, from a stored byte to linear 0…1.
inline const std::array<float, 256>& srgb_to_linear()
{
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double c = double(i) / 255.0;
            values[i] = float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
        }
        return values;
    }();
    return table;
}

}  // namespace lumel
