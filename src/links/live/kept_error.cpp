// Up to second-order terms, the light over all links is the mean of that over the two checkerboard
// halves: half of their difference is a sample of its error. Direct light also has two halves, and
// each half of the links starts from one of them.
//
// Filter weights depend on the noise of the light they were made for, so that light does not show
// the filter's bias. The bias is estimated with weights made from the white links only, applied to
// two quarters a and b of the black ones: the mean of (F a - a) · (F b - b) is the square of F t -
// t, where t is the light without noise.

#include "links/live/kept_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/parallel.h"
#include "links/filter/mean.h"

namespace lumel {
namespace {

/// Lumels are dark below this fraction of the mean, as in LinkRadiosity.
constexpr double kDarkBelow = 1.0 / 3.0;
/// Convergence threshold of a half, for all and for dark lumels: a twentieth of an error of one
/// percent.
constexpr double kResidual = 5e-4;
/// Lumels per task, and per part of a sweep between progress reports.
constexpr std::size_t kJudgedPerTask = 4096, kJudgedPerStep = 1u << 18;
/// Progress at which the filter's bias is estimated.
constexpr double kHalves = 0.4;

/// Light over half of the links.
struct Half {
    LumelSweeps sweeps;
    std::vector<glm::vec3> sky;  ///< [N] [lx]
    bool rests = false;

    /// Runs part of a sweep.
    void step() { rests = rests || (sweeps.step(kJudgedPerStep) && sweeps.rests(kResidual)); }
    /// Irradiance gathered by rays [lx].
    glm::vec3 by_rays(std::size_t i, const DisplayFilter* filter) const
    {
        return filter ? filter->filtered(sweeps, sky, i) : sweeps.received(i) + sky[i];
    }
};

bool is_buried(const LightAtRest& light, std::size_t i)
{
    return (light.lumels[i].flags & kLumelBuried) != 0;
}

/// Sky light by the rays of a half, scaled as if they were all rays.
std::vector<glm::vec3> sky_of(const LumelLinks& links, std::uint32_t half)
{
    std::vector<glm::vec3> sky = links.white_sky_light();
    for (std::size_t i = 0; i < sky.size(); ++i)
        sky[i] = 2.0f * (half == 0 ? sky[i] : links.sky_light()[i] - sky[i]);
    return sky;
}

Half begun(const LightAtRest& light, std::uint32_t half)
{
    Half one{.sweeps = LumelSweeps(light.sweeps, half), .sky = sky_of(light.links, half)};
    std::vector<glm::vec3> direct(light.lamps.begin(), light.lamps.end());
    for (std::size_t i = 0; i < direct.size(); ++i)
        direct[i] += (half == 0 ? light.off[i] : -light.off[i]) + one.sky[i];
    one.sweeps.begin(direct, light.albedo);
    return one;
}

/// [N] Squared noise of each lumel, summed over channels.
std::vector<float> noise_of(const LightAtRest& light, const DisplayFilter* filter,
                            const ProgressCallback& progress)
{
    Half halves[2] = {begun(light, 0), begun(light, 1)};
    while (!halves[0].rests || !halves[1].rests) {
        parallel_for(2, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k)
                halves[k].step();
        });
        notify(progress, 0.0);
    }
    std::vector<float> noise(light.lumels.size(), 0.0f);
    parallel_for(noise.size(), kJudgedPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (!is_buried(light, i)) {
                const glm::vec3 d = light.off[i] + 0.5f * (halves[0].by_rays(i, filter) -
                                                           halves[1].by_rays(i, filter));
                noise[i] = glm::dot(d, d);
            }
    });
    return noise;
}

/// [N] Signed squared filter bias of each lumel.
std::vector<float> wrong_of(const LightAtRest& light, DisplayFilter& filter,
                            const ProgressCallback& progress)
{
    const std::size_t count = light.lumels.size();
    std::array<std::vector<glm::vec3>, 4> quarters;
    for (std::vector<glm::vec3>& quarter : quarters)
        quarter.resize(count);
    parallel_for(count, kJudgedPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::array<glm::vec3, 4> of = light.links.by_quarters(
                i, [&](std::uint32_t end) { return glm::vec3(light.sweeps.sent(end)); });
            for (std::size_t q = 0; q < of.size(); ++q)
                quarters[q][i] = of[q];
        }
    });
    filter.begin({std::move(quarters[0]), std::move(quarters[1])});
    while (!filter.step())
        notify(progress, 0.0);
    const std::vector<glm::vec3>&a = quarters[2], &b = quarters[3];
    std::vector<float> wrong(count, 0.0f);
    parallel_for(count, kJudgedPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (!is_buried(light, i))
                wrong[i] = glm::dot(filter.filtered(a, i) - a[i], filter.filtered(b, i) - b[i]);
    });
    return wrong;
}

/// Sums of squares and of light over some lumels.
struct Sums {
    SquaredError squares;
    double light = 0.0, count = 0.0;

    /// √(Σ d² / 3n) / (Σ H / 3n)
    double relative() const
    {
        return light > 0.0 ? std::sqrt(3.0 * count * squares.sum()) / light : 0.0;
    }
};

}  // namespace

KeptError error_of(const LightAtRest& light, DisplayFilter* filter,
                   const ProgressCallback& progress)
{
    const std::vector<float> noise = noise_of(light, filter, part_of(progress, 0.0, kHalves));
    const std::vector<float> wrong = filter
                                         ? wrong_of(light, *filter, part_of(progress, kHalves, 1.0))
                                         : std::vector<float>(noise.size(), 0.0f);
    const auto sums_below = [&](double most) {
        Sums sums;
        for (std::size_t i = 0; i < noise.size(); ++i) {
            const glm::vec3& all = light.irradiance[i];
            const double here = double(all.r + all.g + all.b);
            if (is_buried(light, i) || !(here < most))
                continue;
            sums.squares.add(double(noise[i]), double(wrong[i]));
            sums.light += here;
            sums.count += 1.0;
        }
        return sums;
    };
    const Sums all = sums_below(std::numeric_limits<double>::infinity());
    if (!(all.light > 0.0))
        return {};
    const Sums dark = sums_below(kDarkBelow * all.light / std::max(all.count, 1.0));
    return {all.relative(), dark.relative()};
}

}  // namespace lumel
