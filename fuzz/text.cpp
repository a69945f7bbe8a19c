#include <cmath>
#include <string>

#include "base/core/number.h"
#include "option_values.h"
#include "readers.h"
#include "scene/sky/light_options.h"
#include "scene/sky/sun.h"

namespace lumel::fuzz {
namespace {

constexpr int kKinds = 5;

void read_number(const std::string& text)
{
    const auto number = number_of(text);
    require(!number || std::isfinite(*number), "numbers are finite");
    constexpr int kLow = -5, kHigh = 1000;
    std::string kept = text;
    if (whole(kLow, kHigh)(kept).empty())
        require(number && *number >= kLow && *number <= kHigh, "whole numbers are within bounds");
    if (between(kLow, kHigh)(kept).empty())
        require(number && *number >= kLow && *number <= kHigh, "numbers are within bounds");
    positive()(kept);
}

}  // namespace

void read_text(Input input)
{
    if (input.empty())
        return;
    const std::string text(input.begin() + 1, input.end());
    LightOptions options;
    switch (input[0] % kKinds) {
    case 0:
        read_number(text);
        break;
    case 1:
        require(std::isfinite(seconds_since_2000(text)), "times are finite");
        break;
    case 2:
        set_sun(options, text);
        require(std::isfinite(glm::length(direction_of(*options.sun))), "the sun is somewhere");
        break;
    case 3:
        set_sky(options, text);
        break;
    default:
        add_profile(options, text);
    }
}

}  // namespace lumel::fuzz
