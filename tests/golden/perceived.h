#pragma once
// Perceptual difference of two pictures.

#include <vector>

#include "../cli/png_picture.h"

namespace lumel::test {

/// [height][width] Distance of the colours in CIE L*a*b* (ΔE 1976; 2.3 is just noticeable), after a
/// Gaussian blur of one pixel: noise of single pixels counts little, a moved shadow in full.
std::vector<float> perceived_difference(const Picture& a, const Picture& b);

struct Perceived {
    double mean = 0.0;
    double high = 0.0;  ///< 99th percentile
};
Perceived summary_of(std::vector<float> difference);

}  // namespace lumel::test
