// LinkRadiosity's light of each lamp, and of sources that are not in the scene. Light is linear in
// its sources: the links serve all lamps, and only direct light, source term and sweeps are a
// lamp's own. The filter has the gains of the whole light, so that the lamps add up to it.

#include <algorithm>
#include <cmath>

#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

constexpr std::size_t kLumelsPerTask = 4096;
/// Least residual of a lamp's sweeps: what they leave out is made good by the exact sum.
constexpr double kLampResidual = 3e-3;

/// Of the filtered light, variance and squared bias left of each lumel's variance [N].
std::vector<double> error_left(const ChartFilter* filter, const Mean& plain, const Mean& filtered)
{
    if (!filter)
        return std::vector<double>(plain.noise.size(), 1.0);
    std::vector<double> error(filtered.noise.begin(), filtered.noise.end());
    for (std::size_t i = 0; i < error.size(); ++i)
        error[i] += double(filtered.wrong[i]);
    std::vector<double> left =
        filter->variance_left({plain.noise.begin(), plain.noise.end()}, error);
    for (double& one : left)
        one = std::max(one, 0.0);
    return left;
}

/// Replaces negative light, which fits can give, by none.
void add_positive(Estimates& sum, const Estimates& light)
{
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += glm::max(light[i], glm::vec3(0.0f));
}

}  // namespace

/// X of kLampLanes lamps at once, in each solution [N][kLampLanes].
struct LinkRadiosity::LampSolutions {
    std::array<std::vector<glm::vec3>, kSolutions> light;

    std::array<glm::vec3, kSolutions> at(std::size_t lumel, std::size_t lane) const
    {
        const std::size_t index = lumel * kLampLanes + lane;
        return {light[0][index], light[1][index], light[2][index]};
    }
};

void LinkRadiosity::drop_round_in_progress()
{
    for (std::size_t k = 0; k < kSolutions; ++k) {
        links_[k]->rounds.resize(round_);
        links_[k]->sky = swept_sky_[k];
    }
}

/// brought() of kLampLanes lamps at once [N][kLampLanes]. received: their X [P][kLampLanes].
template <class Reflected>
std::vector<glm::vec3> LinkRadiosity::brought_by(const Reflected& reflected,
                                                 const SourceTerm& source, const LinkTable& links,
                                                 const std::vector<glm::vec3>& received) const
{
    std::vector<glm::vec3> light(work_.lumels().size() * kLampLanes, glm::vec3(0.0f));
    parallel_for(work_.lumels().size(), kLumelsPerTask, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            float rays = 0.0f;
            for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p)
                rays += source.rays[p];
            for (std::uint32_t p = parts_->first(i); rays > 0.0f && p < parts_->end(i); ++p) {
                const LaneLight<kLampLanes> sky = reflected.of_sky(links.sky[p]);
                for (std::size_t lane = 0; lane < kLampLanes; ++lane) {
                    const glm::vec3 all = source.rays[p] * received[p * kLampLanes + lane];
                    const glm::vec3 first(sky[lane]);
                    light[i * kLampLanes + lane] +=
                        (parts_wanted_ == Parts::all      ? all
                         : parts_wanted_ == Parts::direct ? first
                                                          : all - first) /
                        rays;
                }
            }
        }
    });
    return light;
}

/// The links of one solution tell what surfaces send, a gather along those of each what arrives.
template <class Reflected>
LinkRadiosity::LampSolutions LinkRadiosity::solve_lamps(const Reflected& reflected) const
{
    LampSolutions found;
    std::vector<glm::vec3> bounced;
    for (std::size_t k = 0; k < kSolutions; ++k) {
        const LinkTable& links = *links_[k];
        const SourceTerm source = find_source_term(work_, *parts_, *numbers_, reflected, links);
        if (k == 0) {
            solver_->solve_lamps(links, source, std::max(sweep_residual(), kLampResidual), bounced);
            found.light[k] = brought_by(reflected, source, links, bounced);
        } else {
            std::vector<glm::vec3> received = bounced;
            solver_->gather_lamps(links, source, received);
            found.light[k] = brought_by(reflected, source, links, received);
        }
    }
    return found;
}

/// Adds the light that rays bring, and to `squares` its squared errors. Returns false if progress
/// does.
bool LinkRadiosity::add_indirect_lamps(std::vector<LampLight>& lamps, std::vector<double>& squares,
                                       const std::function<bool(double)>& progress)
{
    const std::size_t count = work_.lumels().size();
    const Solutions whole = brought_light();
    const std::vector<double> left = error_left(filter(), plain_mean(whole), mean_);
    std::vector<Estimates> means(lamps.size(), Estimates(count));
    for (std::size_t first = 0; first < lamps.size(); first += kLampLanes) {
        if (progress && !progress(double(first) / double(lamps.size())))
            return false;
        const LampsReflected reflected(work_, *parts_, *numbers_, *direct_, *lamps_, first);
        const LampSolutions found = solve_lamps(reflected);
        for (std::size_t lamp = first; lamp < std::min(first + kLampLanes, lamps.size()); ++lamp)
            for (std::size_t i = 0; i < count; ++i) {
                const auto [a, b, c] = found.at(i, lamp - first);
                means[lamp][i] = (a + b + c) / 3.0f;
                squares[lamp] += left[i] * spread(a, b, c) / 18.0;
            }
    }
    if (filter())
        filter()->indirect_parts(whole, means);
    for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
        add_positive(lamps[lamp].irradiance, means[lamp]);
    return true;
}

/// Adds direct light, and to `squares` its squared errors.
void LinkRadiosity::add_direct_lamps(std::vector<LampLight>& lamps, std::vector<double>& squares)
{
    const std::size_t count = work_.lumels().size();
    const Estimates &one = direct_->half(0), &other = direct_->half(1);
    // Before the first estimate, the whole is not filtered either.
    const ChartFilter* const by = direct_mean_.light.empty() ? nullptr : filter();
    const std::vector<double> left = error_left(by, plain_mean(one, other), direct_mean_);
    std::vector<Estimates> means(lamps.size(), Estimates(count));
    for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
        for (std::size_t i = 0; i < count; ++i) {
            means[lamp][i] = direct_->mean_of_lamp(i, lamp);
            const glm::vec3 apart = direct_->lamp_apart(i, lamp);
            squares[lamp] += left[i] * 0.25 * double(glm::dot(apart, apart));
        }
    if (by)
        by->direct_parts(one, other, means);
    for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
        add_positive(lamps[lamp].irradiance, means[lamp]);
}

std::vector<glm::vec3> LinkRadiosity::reflected(std::span<const glm::vec3> direct) const
{
    const LampSolutions found = solve_lamps(OutsideReflected(work_, *parts_, *numbers_, direct));
    std::vector<glm::vec3> mean(direct.size());
    parallel_for(mean.size(), kLumelsPerTask, [&](std::size_t from, std::size_t to) {
        for (std::size_t n = from; n < to; ++n)
            mean[n] = (found.light[0][n] + found.light[1][n] + found.light[2][n]) / 3.0f;
    });
    return mean;
}

std::array<Mean, 2> LinkRadiosity::filter_outside(const OutsideLight& whole,
                                                  std::span<Estimates> direct,
                                                  std::span<Estimates> reflected)
{
    const std::size_t count = work_.lumels().size();
    std::vector<glm::vec3> lanes(count * kLampLanes, glm::vec3(0.0f));
    for (std::size_t i = 0; i < count; ++i)
        lanes[i * kLampLanes] = whole.sent[i];
    const LampSolutions found = solve_lamps(OutsideReflected(work_, *parts_, *numbers_, lanes));
    Solutions solutions;
    for (std::size_t k = 0; k < kSolutions; ++k)
        for (std::size_t i = 0; i < count; ++i)
            solutions[k].push_back(found.light[k][i * kLampLanes]);
    filter()->indirect_parts(solutions, reflected);
    filter()->direct_parts(whole.one, whole.other, direct);
    return {filter()->indirect(solutions), filter()->direct(whole.one, whole.other)};
}

/// Scales the lamps of each lumel so that they add up to its light: their sweeps end at a residual,
/// and no light is negative. Light without a lamp goes to the brightest lamp of the
/// previous lumel. Returns LampsLight::missing.
double LinkRadiosity::make_sum_exact(std::vector<LampLight>& lamps) const
{
    const std::size_t tasks = (work_.order.size() + kLumelsPerTask - 1) / kLumelsPerTask;
    std::vector<glm::dvec2> sums(tasks, glm::dvec2(0.0));  // of lamps, of the whole
    parallel_for(tasks, 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t task = from; task < to; ++task) {
            std::size_t brightest = 0;
            const std::size_t end = std::min((task + 1) * kLumelsPerTask, work_.order.size());
            for (std::size_t o = task * kLumelsPerTask; o < end; ++o) {
                const std::uint32_t i = work_.order[o];
                const glm::vec3 whole = arrived(i);
                glm::vec3 sum(0.0f);
                for (std::size_t k = 0; k < lamps.size(); ++k) {
                    sum += lamps[k].irradiance[i];
                    if (luminance(lamps[k].irradiance[i]) >
                        luminance(lamps[brightest].irradiance[i]))
                        brightest = k;
                }
                for (int c = 0; c < 3; ++c) {
                    for (LampLight& lamp : lamps)
                        lamp.irradiance[i][c] *= sum[c] > 0.0f ? whole[c] / sum[c] : 0.0f;
                    if (!(sum[c] > 0.0f))
                        lamps[brightest].irradiance[i][c] = whole[c];
                }
                sums[task] +=
                    glm::dvec2(double(sum.r + sum.g + sum.b), double(whole.r + whole.g + whole.b));
            }
        }
    });
    glm::dvec2 all(0.0);
    for (const glm::dvec2& sum : sums)
        all += sum;
    return all.y > 0.0 ? 1.0 - all.x / all.y : 0.0;
}

std::optional<LinkRadiosity::LampsLight>
LinkRadiosity::light_of_lamps(const std::function<bool(double)>& progress)
{
    work_.ranks = nullptr;  // only the first rank gets here
    const std::size_t count = work_.lumels().size();
    LampsLight found{std::vector<LampLight>(lamp_count())};
    for (LampLight& lamp : found.lamps)
        lamp.irradiance.assign(count, glm::vec3(0.0f));
    std::vector<double> squares(found.lamps.size(), 0.0);
    if (!mean_.light.empty()) {
        drop_round_in_progress();
        if (!add_indirect_lamps(found.lamps, squares, progress))
            return std::nullopt;
    }
    if (direct_ && parts_wanted_ != Parts::indirect)
        add_direct_lamps(found.lamps, squares);
    found.missing = make_sum_exact(found.lamps);
    for (std::size_t k = 0; k < found.lamps.size(); ++k) {
        double light = 0.0, lumels = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            if (!work_.is_buried(i)) {
                const glm::vec3& own = found.lamps[k].irradiance[i];
                light += double(own.r + own.g + own.b);
                lumels += 1.0;
            }
        // √(Σ d² / 3n) / (Σ H / 3n)
        found.lamps[k].error = light > 0.0 ? std::sqrt(3.0 * lumels * squares[k]) / light : 0.0;
    }
    return found;
}

}  // namespace lumel
