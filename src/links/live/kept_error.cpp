// The light over all links is, but for terms of second order, the mean of that over the white and
// that over the black ones: half of their difference is a draw of its error. Like the links, direct
// light has two halves, and each of the former begins from one of the latter.
//
// Weights of a filter follow the noise of the light that they were made for, and what they get
// wrong does not show in it. So it is found by weights that know the white links alone, by what
// they do to two quarters of the black ones: the mean of (F a - a) · (F b - b) is the square of F t
// - t, with t the light without noise.

#include "links/live/kept_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/parallel.h"
#include "links/filter/mean.h"

namespace lumel {
namespace {

/// Lumels are dark below this part of the mean, as of LinkRadiosity.
constexpr double kDark = 1.0 / 3.0;
/// Light still to come to a half, as a part of all and of dark lumels' own: a twentieth of an error
/// that is a percent.
constexpr double kResidual = 5e-4;
/// Lumels worth a task, and those of a sweep between two progress reports.
constexpr std::size_t kGrain = 4096, kStep = 1u << 18;
/// Part of the time until the filter is judged, about.
constexpr double kHalves = 0.4;

/// The light over half of the links.
struct Half {
    LumelSweeps sweeps;
    std::vector<glm::vec3> sky;  ///< [N] [lx]
    bool rests = false;

    /// A part of a sweep.
    void step() { rests = rests || (sweeps.step(kStep) && sweeps.rests(kResidual)); }
    /// What rays bring [lx].
    glm::vec3 by_rays(std::size_t i, const DisplayFilter* filter) const
    {
        return filter ? filter->filtered(sweeps, sky, i) : sweeps.received(i) + sky[i];
    }
};

bool is_buried(const LightAtRest& light, std::size_t i)
{
    return (light.lumels[i].flags & kLumelBuried) != 0;
}

/// Light of the sky by the rays of a half, as if they were all.
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

/// [N] Squares of what noise makes of each lumel, all channels together.
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
    parallel_for(noise.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (!is_buried(light, i)) {
                const glm::vec3 d = light.off[i] + 0.5f * (halves[0].by_rays(i, filter) -
                                                           halves[1].by_rays(i, filter));
                noise[i] = glm::dot(d, d);
            }
    });
    return noise;
}

/// [N] Squares, of any sign, of what the filter gets wrong of each lumel.
std::vector<float> wrong_of(const LightAtRest& light, DisplayFilter& filter,
                            const ProgressCallback& progress)
{
    const std::size_t count = light.lumels.size();
    std::array<std::vector<glm::vec3>, 4> quarters;
    for (std::vector<glm::vec3>& quarter : quarters)
        quarter.resize(count);
    parallel_for(count, kGrain, [&](std::size_t first, std::size_t last) {
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
    parallel_for(count, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (!is_buried(light, i))
                wrong[i] = glm::dot(filter.filtered(a, i) - a[i], filter.filtered(b, i) - b[i]);
    });
    return wrong;
}

/// Of some lumels: sums of squares and of light.
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
    const Sums dark = sums_below(kDark * all.light / std::max(all.count, 1.0));
    return {all.relative(), dark.relative()};
}

}  // namespace lumel
