// LinkRadiosity's errors: of the whole map, of dark lumels, as an eye sees it, and visible noise.

#include <algorithm>
#include <cmath>

#include "base/core/luminance.h"
#include "links/direct/deviation.h"
#include "links/filter/adapted_light.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

/// Lumels below this fraction of the mean are dark.
constexpr double kDark = 1.0 / 3.0;

}  // namespace

/// Adds the error of direct light to that of rays.
void LinkRadiosity::estimate()
{
    struct Sums {
        SquaredError rays;
        SquaredError direct;
        double light = 0.0, count = 0.0;

        /// √(Σ d² / 3n) / (Σ H / 3n), squared
        double relative(double squares) const
        {
            return light > 0.0 ? 3.0 * count * squares / (light * light) : 0.0;
        }
        Errors errors() const { return {relative(rays.sum()), relative(direct.sum())}; }
    };
    direct_mean_ = filter() && parts_wanted_ != Parts::indirect
                       ? filter()->direct(direct_->half(0), direct_->half(1))
                       : plain_mean(direct_->half(0), direct_->half(1));
    const auto add = [&](Sums& sums, std::size_t i, double light) {
        if (parts_wanted_ != Parts::indirect)
            sums.direct.add(direct_mean_, i);
        if (!mean_.light.empty())
            sums.rays.add(mean_, i);
        sums.light += light;
        sums.count += 1.0;
    };
    const auto visit = [&](const auto& what) {
        for (std::size_t i = 0; i < work_.lumels().size(); ++i)
            if (!work_.is_buried(i)) {
                const glm::vec3 all = arrived(i);
                what(i, double(all.r + all.g + all.b));
            }
    };
    Sums all, dark;
    visit([&](std::size_t i, double light) { add(all, i, light); });
    mean_light_ = all.light / std::max(all.count, 1.0);
    visit([&](std::size_t i, double light) {
        if (light < kDark * mean_light_)
            add(dark, i, light);
    });
    errors(ErrorOf::all) = all.errors();
    errors(ErrorOf::dark) = dark.errors();
    errors(ErrorOf::eye) = estimate_for_eye();
    const auto root = [&](ErrorOf of) { return std::sqrt(errors(of).rays + errors(of).direct); };
    state_.error = root(ErrorOf::all);
    state_.dark_error = root(ErrorOf::dark);
    state_.eye_error = root(ErrorOf::eye);
    find_visible_noise();
}

LinkRadiosity::Errors LinkRadiosity::errors_in(const ChartNoise& chart, std::size_t band)
{
    return {chart.power[0][band], chart.power.size() > 1 ? chart.power[1][band] : 0.0};
}

/// Visible noise of the present estimate.
void LinkRadiosity::find_visible_noise()
{
    if (mean_.light.empty())
        return;
    std::vector<float> light(work_.lumels().size());
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = float(luminance(arrived(i)));
    std::vector<const Mean*> means = {&mean_};
    if (parts_wanted_ != Parts::indirect)
        means.push_back(&direct_mean_);
    noise_ = noise_of_charts(work_.scene, light, means, work_.ranks);
    state_.visible_noise = visible_noise(noise_);
    errors(ErrorOf::chart) = {};
    if (!noise_.empty()) {
        const ChartNoise& worst = noise_[worst_that_counts(noise_)];
        errors(ErrorOf::chart) = errors_in(worst, worst.worst_band());
    }
}

std::vector<NoisySurface> LinkRadiosity::noisy_surfaces() const
{
    std::vector<NoisySurface> surfaces;
    for (auto chart = noise_.rbegin(); chart != noise_.rend(); ++chart) {
        const double noise = std::sqrt(chart->power_in(chart->worst_band()));
        const std::uint32_t instance = work_.lumels()[chart->lumels.front()].instance;
        const bool is_known =
            std::ranges::find(surfaces, instance, &NoisySurface::instance) != surfaces.end();
        if (target_visible_noise_ > 0.0 && noise > target_visible_noise_ && !is_known)
            surfaces.push_back({instance, noise});
    }
    return surfaces;
}

/// Mean of squared errors relative to the light that an eye adapts to.
LinkRadiosity::Errors LinkRadiosity::estimate_for_eye()
{
    std::vector<double> light(work_.lumels().size());
    for (std::size_t i = 0; i < light.size(); ++i) {
        const glm::vec3 all = arrived(i);
        light[i] = double(all.r + all.g + all.b);
    }
    adapted_ = adapted_light(work_.scene.lumels, light);
    SquaredError rays, direct;
    double count = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (work_.is_buried(i))
            continue;
        count += 1.0;
        if (!(adapted_[i] > 0.0))
            continue;
        // √(Σ d² / 3) / (Σ adapted / 3), squared
        const double weight = 3.0 / (adapted_[i] * adapted_[i]);
        if (parts_wanted_ != Parts::indirect)
            direct.add(direct_mean_, i, weight);
        if (!mean_.light.empty())
            rays.add(mean_, i, weight);
    }
    return {rays.sum() / std::max(count, 1.0), direct.sum() / std::max(count, 1.0)};
}

/// Irradiance at a lumel, of the requested parts of light [lx].
glm::vec3 LinkRadiosity::arrived(std::size_t i) const
{
    const glm::vec3 direct = parts_wanted_ == Parts::indirect ? glm::vec3(0.0f)
                             : direct_mean_.light.empty()     ? direct_->mean(i)
                                                              : direct_mean_.light[i];
    return mean_.light.empty() ? direct : direct + mean_.light[i];
}

/// The square of one lumel is a rough estimate, so that of its neighbours counts too.
std::vector<float> LinkRadiosity::error_estimate() const
{
    std::vector<float> error(work_.lumels().size(), 1.0f);
    if (mean_.light.empty())
        return error;
    const auto deviation = [&](const Mean& of, NearReach reach) {
        std::vector<double> square(of.noise.begin(), of.noise.end());
        double noise = 0.0, wrong = 0.0;
        for (std::size_t i = 0; i < square.size(); ++i)
            if (!work_.is_buried(i)) {
                noise += square[i];
                wrong += double(of.wrong[i]);
            }
        // The filter's bias is known on average only.
        const double with_bias = noise > 0.0 ? std::max(1.0 + wrong / noise, 0.0) : 1.0;
        for (double& one : square)
            one *= with_bias;
        return deviation_nearby(square, work_.scene.lumels, work_.order, reach, 1.0);
    };
    const std::vector<double> of_rays = deviation(mean_, kIndirectReach);
    std::vector<double> of_direct(error.size(), 0.0);
    if (parts_wanted_ != Parts::indirect)
        of_direct = deviation(direct_mean_, kDirectReach);
    for (std::size_t i = 0; i < error.size(); ++i) {
        const glm::vec3 all = arrived(i);
        const double light = double(all.r + all.g + all.b);
        // √(Σ d² / 3) / (Σ H / 3)
        error[i] = work_.is_buried(i) || !(light > 0.0)
                       ? 0.0f
                       : float(std::min(
                             std::sqrt(3.0) * std::hypot(of_rays[i], of_direct[i]) / light, 1.0));
    }
    return error;
}

}  // namespace lumel
