#include "truth/averages.h"

#include <algorithm>

#include "base/core/parallel.h"

namespace lumel {

namespace {

constexpr int kSamplesPerPass = 16;
/// Values between progress reports.
constexpr std::size_t kValuesPerPass = 8192;
constexpr std::size_t kValuesPerTask = 16;

}  // namespace

std::vector<glm::vec4> average(std::size_t count, int samples, const Estimate& estimate,
                               const std::function<bool(double)>& progress)
{
    std::vector<glm::dvec4> sums(count, glm::dvec4(0.0));
    std::vector<int> taken(count, 0);

    // Passes over all values a few samples at a time: a stopped run is noisier, but complete.
    bool stopped = false;
    for (int done = 0; done < samples && !stopped; done += kSamplesPerPass) {
        const int until = std::min(done + kSamplesPerPass, samples);
        const auto take = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                for (int sample = done; sample < until; ++sample)
                    sums[i] += glm::dvec4(estimate(i, std::uint32_t(sample)));
                taken[i] = until;
            }
        };
        const auto report = [&](std::size_t values) {
            const double share = double(values) / double(count);
            return !progress || progress((share * (until - done) + done) / samples);
        };
        stopped = !parallel_steps(count, kValuesPerPass, kValuesPerTask, take, report);
    }

    if (std::find(taken.begin(), taken.end(), 0) != taken.end())
        return {};
    std::vector<glm::vec4> means(count);
    for (std::size_t i = 0; i < count; ++i)
        means[i] = glm::vec4(sums[i] / double(taken[i]));
    return means;
}

}  // namespace lumel
