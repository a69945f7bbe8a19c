#pragma once
// Illuminance in false colours with a legend; the scale is that of pages (page/viewer/colours.js).

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "base/core/image.h"

namespace lumel {

/// Logarithmic scale.
struct LuxScale {
    double low = 0.1, high = 1.0;  ///< [lx]

    double place_of(double lux) const;  ///< 0 at low, 1 at high
    double lux_at(double place) const;
    /// Ticks: 1, 2 and 5 times powers of ten within the scale, ascending [lx].
    std::vector<double> ticks() const;
};

/// Scale from the 2nd to the 99.5th percentile of positive values, rounded to ticks; at least a
/// decade.
LuxScale scale_for(std::span<const float> lux);

/// sRGB code 0…1 of a position on the scale: blue, green, yellow, with increasing lightness.
glm::vec3 scale_color(double place);

/// Text of a tick in the legend: "0.05", "200", "10000".
std::string tick_text(double lux);

/// Display-referred image with 3 channels. lux: one channel, negative where there is no
/// surface, which becomes grey.
Image colours_of(const Image& lux, const LuxScale& scale);

/// As colours_of, with a legend of the scale in `unit`.
Image false_colour(const Image& lux, const LuxScale& scale, std::string_view unit = "lx");

}  // namespace lumel
