#pragma once
// Illuminance as colours, with a legend: the scale of pages (page/viewer/colours.js).

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/image.h"

namespace lumel {

/// Equal steps for equal ratios.
struct LuxScale {
    double low = 0.1, high = 1.0;  ///< [lx]

    double place_of(double lux) const;  ///< 0 at low, 1 at high
    double lux_at(double place) const;
    /// Numbers of the form 1, 2 and 5 times a power of ten that lie on it, rising [lx].
    std::vector<double> ticks() const;
};

/// From 2 to 99.5 % of what is above 0, in numbers of the same form, a decade or more.
LuxScale scale_for(std::span<const float> lux);

/// sRGB code 0…1 of a place of the scale: blue, green, yellow, of rising lightness.
glm::vec3 scale_color(double place);

/// A tick as the legend writes it: "0.05", "200", "10000".
std::string tick_text(double lux);

/// One channel of lux, less than 0 where there is nothing (grey), as a picture of 3 channels,
/// display-referred.
Image colours_of(const Image& lux, const LuxScale& scale);

/// The same with the scale and its numbers beside it, in lux or in another unit: "%".
Image false_colour(const Image& lux, const LuxScale& scale, std::string_view unit = "lx");

}  // namespace lumel
