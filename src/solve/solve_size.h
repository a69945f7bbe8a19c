#pragma once
// What the memory that a solver takes depends on.

#include "atlas/atlas.h"
#include "solve/solver.h"

namespace lumel {

/// Beside the options.
struct SolveSize {
    const Lumels* lumels = nullptr;
    std::uint64_t near_pairs = 0;  ///< of the near field, as many as its table has
    float diagonal = 0.0f;         ///< of the scene's bounding box [m]

    std::size_t count() const { return lumels->lumels.size(); }  ///< N
    std::uint64_t texels() const { return std::uint64_t(lumels->width) * lumels->height; }
};

/// Bytes on the device that the solver of the options' method takes at most, on one whose images
/// may be as large as is wanted. Throws Error{input} if there is no such method.
std::uint64_t solver_bytes(const SolveSize& size, const SolverOptions& options);

}  // namespace lumel
