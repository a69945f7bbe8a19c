#pragma once
// Whether a scene from a compressed file is that of its plain twin.

#include "scene/values/scene.h"

namespace lumel::test {

/// How far the compressed file may be from the plain one.
struct TwinSteps {
    float position = 0.0f;  ///< [m]
    float normal = 0.0f;    ///< distance of unit vectors
    float texcoord = 0.0f;
    std::size_t set = 0;  ///< of texture coordinates: TEXCOORD_n
};

/// Expects that instances have the same names and materials, and that every triangle of one has a
/// twin in the other with the same sense of rotation. Vertices and triangles may be in any order.
void expect_twins(const Scene& plain, const Scene& packed, const TwinSteps& steps);

/// Area of all that it shows [m²].
double area_of(const Scene& scene);

}  // namespace lumel::test
