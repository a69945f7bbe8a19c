#pragma once
// Options of the iteration scheme.

namespace lumel {

enum class Scheme {
    phased,  ///< source frozen in phases of doubling length, near pairs exact (the default)
    paper,   ///< the papers' iteration: random shooters, running average, no near field
};

struct IterationOptions {
    Scheme scheme = Scheme::phased;
    /// Scheme::paper: fraction of the solution that each shot replaces, [TN11] section 5 (0.01), so
    /// that it follows changes of the light. 0: the mean of all shots, which converges.
    double leak = 0.0;
};

}  // namespace lumel
