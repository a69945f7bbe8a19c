#pragma once
// A scene's form factors, and light to send through them.

#include "bench/papers/figures.h"
#include "solve/matrix/bounces.h"
#include "solve/matrix/elements.h"
#include "solve/transport/transport.h"

namespace lumel::bench {

struct MatrixCase {
    Elements elements;
    SquareMatrix form_factors;                   ///< [n][n]
    ColorMatrix bounces;                         ///< [n][n] of all reflections
    std::vector<std::vector<glm::vec3>> lights;  ///< direct light of each state, [n]

    std::uint32_t size() const { return form_factors.size; }
};

/// Form factors and reflections between the scene's patches.
Transport transport_of(const gpu::Device& device, const SolveScene& world,
                       const MatrixOptions& options);

/// At most `patches` of the scene; lit by a number of point lights, one in each state, at places
/// drawn from its box, of which those count that light a quarter of its lumels or more. Throws
/// Error.
MatrixCase make_matrix_case(const gpu::Device& device, const Settings& settings,
                            std::uint32_t patches, int lights);

/// Relative root-mean-square difference over patches by area and channels.
struct StateError {
    double mean = 0.0, worst = 0.0;  ///< of states
};

/// Of the light that `found` makes of the case's states, against the whole matrix.
StateError light_error(const MatrixCase& matrix_case, const ColorMatrix& found);

}  // namespace lumel::bench
