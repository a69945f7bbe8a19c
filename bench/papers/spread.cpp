#include "bench/papers/spread.h"

#include <algorithm>
#include <cmath>

namespace lumel::bench {

void Spread::add(const std::vector<double>& values)
{
    if (first_.empty()) {
        first_ = values;
        sum_.resize(values.size());
        squares_.resize(values.size());
    }
    runs_ += 1.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double difference = values[i] - first_[i];
        sum_[i] += difference;
        squares_[i] += difference * difference;
    }
}

double Spread::mean() const
{
    double sum = 0.0;
    for (std::size_t i = 0; i < sum_.size(); ++i)
        sum += first_[i] + sum_[i] / runs_;
    return sum / double(sum_.size());
}

double Spread::variance_of(std::size_t i) const
{
    return std::max(squares_[i] - sum_[i] * sum_[i] / runs_, 0.0) / (runs_ - 1.0);
}

double Spread::variance() const
{
    double sum = 0.0;
    for (std::size_t i = 0; i < sum_.size(); ++i)
        sum += variance_of(i);
    return sum / double(sum_.size()) / (mean() * mean());
}

double Spread::largest() const
{
    double most = 0.0;
    for (std::size_t i = 0; i < sum_.size(); ++i)
        most = std::max(most, variance_of(i));
    return std::sqrt(most) / mean();
}

}  // namespace lumel::bench
