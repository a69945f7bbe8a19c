#pragma once
// How far runs with different seeds lie apart.

#include <cstddef>
#include <vector>

namespace lumel::bench {

/// Mean and variance between runs, value by value.
class Spread {
public:
    /// One run. All have the same number of values.
    void add(const std::vector<double>& values);

    double mean() const;      ///< over runs and values
    double variance() const;  ///< between runs, its mean over values, over mean()²
    double largest() const;   ///< largest standard deviation of a value, over mean()

private:
    double variance_of(std::size_t i) const;

    std::vector<double> sum_, squares_;  ///< of differences from the first run
    std::vector<double> first_;
    double runs_ = 0.0;
};

}  // namespace lumel::bench
