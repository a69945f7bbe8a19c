#pragma once
// The difference of two pictures as an eye sees it.

#include <vector>

#include "../cli/png_picture.h"

namespace lumel::test {

/// [height][width] Distance of the colours in CIE L*a*b* (ΔE 1976; 2.3 is just noticeable), after a
/// blur as of an eye that cannot tell a pixel from the next: noise of single pixels counts little,
/// a shadow that is elsewhere counts whole.
std::vector<float> perceived_difference(const Picture& a, const Picture& b);

struct Perceived {
    double mean = 0.0;
    double high = 0.0;  ///< that 1 % of the pixels exceed
};
Perceived summary_of(std::vector<float> difference);

}  // namespace lumel::test
