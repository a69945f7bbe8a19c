#pragma once
// What every method offers, and the one table of methods.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "reference/reference.h"

namespace lumel {

enum class Scheme {
    phased,  ///< source frozen in phases of doubling length, near pairs exact (the default)
    paper,   ///< the papers' iteration: one random shooter, running average, no near table
};

struct SolverOptions {
    std::string method = "stochastic";  ///< id in kMethods
    Scheme scheme = Scheme::phased;
    SampleRule rule = SampleRule::area;
    std::uint32_t seed = 1;
    int batch = 16;                     ///< K, shooters per iteration
    int hemicube = 256;                 ///< side of the front face [pixels]
    std::uint64_t max_shots = 0;        ///< 0: no limit
    double max_seconds = 0.0;           ///< of solving, 0: no limit
    double target_error = 0.02;         ///< estimated relative error to stop at, 0: never
};

/// A method of the table: what the user can ask for by --solver.
struct MethodInfo {
    const char* id;
    const char* title;
    const char* paper;
    const char* advice;
};

inline constexpr MethodInfo kMethods[] = {
    {"stochastic", "Stochastic radiosity by perspective ray bundles", "[SKB03], [BSS05]",
     "the default: any scene with diffuse surfaces and emissive lights"},
};

}  // namespace lumel
