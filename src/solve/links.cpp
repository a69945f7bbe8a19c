// Radiosity over links: all light that a lumel receives is direct light D, which rays to points on
// light sources find, and what rays spread by the cosine bring. Each of these is traced once. The
// part of a lumel that it meets is kept, a link of four bytes, and
//
//     H = D + X,    X_p = (1/n_p) Σ_k ρ (D + X)[target_pk]  + sky,
//
// is solved over the links, sweep by sweep, for all bounces at once (links/sweeps.cpp). The cost
// grows with the number of lumels, as there is no shooter whose light falls off with the square of
// the distance.
//
// Two solutions share nothing random: each has its own links, and direct light is found in two
// halves. The result is their mean, and their difference is the error that is stated.
//
// A lumel is too coarse where light changes within it: it has a grid of cells for direct light, and
// parts, each with an X of its own, where geometry cuts it (links/cells.h).

#include "solve/links.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <numeric>

#include "atlas/morton.h"
#include "core/frame.h"
#include "core/luminance.h"
#include "paths/samples.h"
#include "solve/methods.h"

namespace lumel {
namespace {

/// Rays of a lumel in each half of the first round; powers of two, which stratify best.
constexpr std::uint32_t kFirstRays = 8;
/// A later round has at least this share of the rays so far, and so many rays of a lumel at most.
constexpr double kLeastMore = 0.25, kMostMore = 3.0;
/// Rays that are shared out by deviation do as much as 1 / kAdaptiveGain times as many even ones.
constexpr double kAdaptiveGain = 0.6;
constexpr std::uint32_t kMostRays = 4096;
/// Share of its rays that go to all lumels alike; neighbours on either side, in the order of
/// lumels, from which the deviation of one is guessed.
constexpr double kEvenShare = 0.25;
constexpr std::size_t kNeighbours = 4;
/// Blocks of links that one step traces at the first round's number of rays.
constexpr std::size_t kBlocksPerStep = 128;
/// Direct light is found better if its noise is more than this share of all; and alone, without
/// more links, if it is more than that share.
constexpr double kMostOfDirect = 0.5, kRestOfLinks = 0.8;
/// Mean albedo of rooms whose level is balanced.
constexpr double kBrightRoom = 0.95;
/// Lumels that are darker than this share of the mean are dark.
constexpr double kDark = 1.0 / 3.0;
/// None counts as darker than this share of the mean where rays are shared out.
constexpr double kDarkest = 1e-2;
/// Key of the lumels' order: cells of the scene along each axis, within which lumels are sorted by
/// the side that they face.
constexpr double kOrderCells = 32.0;
/// Random streams: of parts, of direct light, and of links of either half.
constexpr std::uint32_t kPartStream = 1, kDirectStream = 2, kLinkStream = 3;

/// Lumels such that neighbours in space that face alike come together: their rays meet the same
/// things.
std::vector<std::uint32_t> order_in_space(const WorldLumels& world)
{
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (std::size_t i = 0; i < world.size(); ++i) {
        low = glm::min(low, world[i].centre);
        high = glm::max(high, world[i].centre);
    }
    const double side = std::max(double(glm::distance(low, high)), 1e-30);
    struct Key {
        std::uint64_t cell, side, fine;
        std::uint32_t lumel;
        auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys(world.size());
    for (std::size_t i = 0; i < world.size(); ++i) {
        const glm::dvec3 at = glm::dvec3(world[i].centre - low) / side;
        keys[i] = {morton_code(glm::floor(at * kOrderCells) / kOrderCells),
                   std::uint64_t(cube_side(world[i].normal)), morton_code(at), std::uint32_t(i)};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(world.size());
    std::transform(keys.begin(), keys.end(), order.begin(),
                   [](const Key& key) { return key.lumel; });
    return order;
}

std::vector<char> buried(const Lumels& lumels)
{
    std::vector<char> result(lumels.lumels.size());
    std::transform(lumels.lumels.begin(), lumels.lumels.end(), result.begin(),
                   [](const Lumel& lumel) { return (lumel.flags & kLumelBuried) != 0; });
    return result;
}

/// Adds the time that something takes to a stage [ms].
class Clock {
public:
    explicit Clock(double& sum) : sum_(sum) {}
    ~Clock()
    {
        sum_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
                    .count();
    }
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;

private:
    double& sum_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

LinkRadiosity::LinkRadiosity(const HostScene& host, const Lumels& lumels,
                             const LinksOptions& options, const SolverOptions& limits, Parts parts)
    : options_(options),
      target_error_(limits.target_error),
      target_dark_error_(limits.target_dark_error),
      parts_wanted_(parts),
      lumels_(lumels),
      surfaces_(host.scene),
      place_{host.scene, surfaces_, host.rays, host.atlas, lumels},
      world_(host.scene, host.rays, lumels),
      cells_(world_),
      starts_(world_, cells_, host.rays.lift(), options.rule == SampleRule::centre),
      sources_(host.scene, surfaces_, glm::distance(host.rays.low(), host.rays.high())),
      order_(order_in_space(world_))
{
}

LinkRadiosity::~LinkRadiosity() = default;

void LinkRadiosity::step()
{
    switch (stage_) {
    case Stage::begin: {
        const Clock clock(times_["parts of lumels"]);
        cut();
        stage_ = Stage::direct;
        break;
    }
    case Stage::direct: {
        const Clock clock(times_["direct light"]);
        if (direct_->step())
            break;
        if (refines_alone_) {
            refines_alone_ = false;
            estimate();
            go_on();
        } else {
            begin_round();
        }
        break;
    }
    case Stage::links: {
        const Clock clock(times_["links"]);
        const std::size_t count =
            std::max(std::size_t(double(kBlocksPerStep * kFirstRays) / mean_rays_), std::size_t(1));
        const std::size_t last = std::min(traced_ + count, tracer_->blocks());
        for (std::uint32_t h = 0; h < 2; ++h)
            tracer_->trace(traced_, last, rays_, kLinkStream + 2 * round_ + h, *gathered_[h]);
        traced_ = last;
        if (traced_ == tracer_->blocks())
            stage_ = Stage::solve;
        break;
    }
    case Stage::solve: {
        const Clock clock(times_["sweeps"]);
        end_round();
        break;
    }
    }
    ++state_.iterations;
}

void LinkRadiosity::cut()
{
    parts_.emplace(world_, cells_, place_.rays, buried(lumels_),
                   PathSamples::hash(options_.seed, kPartStream));
    direct_.emplace(place_, sources_, starts_, order_,
                    PathSamples::hash(options_.seed, kDirectStream));
    tracer_.emplace(place_, sources_, world_, starts_, cells_, *parts_, *direct_, order_,
                    options_.seed);
    solver_.emplace(lumels_, world_, *parts_, order_);
    for (std::optional<Gathered>& half : gathered_)
        half.emplace(parts_->count());
}

/// As many rays as the error still asks for, within limits.
void LinkRadiosity::begin_round()
{
    mean_rays_ = kFirstRays;
    if (state_.shots > 0) {
        const double so_far = double(state_.shots) / 2.0;
        double more = so_far;
        if (const double ratio = missing(); ratio > 0.0) {
            more = std::clamp(kAdaptiveGain * so_far * (ratio * ratio - 1.0), kLeastMore * so_far,
                              kMostMore * so_far);
        }
        mean_rays_ = std::min(more, double(kMostRays));
    }
    share_out_rays();
    traced_ = 0;
    stage_ = Stage::links;
    for (std::optional<Gathered>& half : gathered_)
        half->rounds.emplace_back(tracer_->blocks());
}

/// The sum of variances is least if rays are in proportion to deviations. That of a lumel is
/// guessed from the halves of its neighbours in space, not from its own: they are to state the
/// error, and rays must not follow them. A part of the rays goes to all alike, since what has not
/// met any light yet looks quiet.
void LinkRadiosity::share_out_rays()
{
    rays_.assign(order_.size(), std::uint16_t(std::lround(mean_rays_)));
    if (state_.shots == 0)
        return;
    const std::size_t count = order_.size();
    std::vector<double> running(count + 1, 0.0), deviation(count);
    const double floor = kDarkest * mean_light_;
    for (std::size_t o = 0; o < count; ++o) {
        const glm::vec3 a = indirect(order_[o], 0), b = indirect(order_[o], 1), d = a - b;
        // Where dark lumels count, what they lack counts by their own light, half way.
        const double weight = target_dark_error_ > 0.0
                                  ? 1.0 / (double(a.r + a.g + a.b + b.r + b.g + b.b) + floor)
                                  : 1.0;
        running[o + 1] = running[o] + weight * double(glm::dot(d, d));
    }
    double mean = 0.0, lit = 0.0;
    for (std::size_t o = 0; o < count; ++o) {
        const std::size_t first = o - std::min(o, kNeighbours);
        const std::size_t last = std::min(o + kNeighbours + 1, count);
        const double own = running[o + 1] - running[o];
        deviation[o] = std::sqrt(std::max(running[last] - running[first] - own, 0.0) /
                                 double(std::max<std::size_t>(last - first - 1, 1)));
        if (!(lumels_.lumels[order_[o]].flags & kLumelBuried)) {
            mean += deviation[o];
            lit += 1.0;
        }
    }
    mean /= std::max(lit, 1.0);
    if (!(mean > 0.0))
        return;
    for (std::size_t o = 0; o < count; ++o) {
        const double share = kEvenShare + (1.0 - kEvenShare) * deviation[o] / mean;
        rays_[order_[o]] =
            std::uint16_t(std::clamp(std::lround(mean_rays_ * share), 0l, long(kMostRays)));
    }
}

void LinkRadiosity::end_round()
{
    for (int h = 0; h < 2; ++h) {
        solver_->solve(*gathered_[h], received_[std::size_t(h)]);
        balance(h);
    }
    state_.shots += 2 * std::uint64_t(std::llround(mean_rays_));
    ++round_;
    estimate();
    go_on();
}

/// In a bright closed room the level of all light has a noise of its own, but what surfaces absorb
/// is known: all that is sent, Σ A (1 - ρ) (D + X) = Σ A D.
void LinkRadiosity::balance(int half)
{
    if (!gathered_[half]->is_closed())
        return;
    glm::dvec3 absorbed(0.0), reflected(0.0);
    double area = 0.0, albedo = 0.0;
    for (std::size_t i = 0; i < lumels_.lumels.size(); ++i) {
        const Lumel& lumel = lumels_.lumels[i];
        if (lumel.flags & kLumelBuried)
            continue;
        const double a = double(lumel.area);
        absorbed += a * glm::dvec3((1.0f - lumel.albedo) * indirect(i, half));
        reflected += a * glm::dvec3(lumel.albedo * direct_->half(half)[i]);
        area += a;
        albedo += a * double(lumel.albedo.r + lumel.albedo.g + lumel.albedo.b) / 3.0;
    }
    if (albedo < kBrightRoom * area)
        return;
    glm::vec3 factor(1.0f);
    for (int c = 0; c < 3; ++c)
        if (absorbed[c] > 0.0)
            factor[c] = float(reflected[c] / absorbed[c]);
    for (glm::vec3& light : received_[std::size_t(half)])
        light *= factor;
}

/// How many times larger the error is than the one asked for; 0: none is asked for.
double LinkRadiosity::missing() const
{
    double ratio = 0.0;
    if (target_error_ > 0.0)
        ratio = std::max(ratio, state_.error / target_error_);
    if (target_dark_error_ > 0.0)
        ratio = std::max(ratio, state_.dark_error / target_dark_error_);
    return ratio;
}

/// What comes next: better direct light, more links, or both.
void LinkRadiosity::go_on()
{
    const bool wanted = target_error_ > 0.0 || target_dark_error_ > 0.0;
    if (wanted && missing() <= 1.0)
        return;
    // Better direct light may take as many rays as there are links, no more.
    const bool affordable = direct_->rays_to_refine() <= state_.shots * order_.size();
    if (direct_error_ > kMostOfDirect * state_.error && affordable && direct_->refine()) {
        refines_alone_ = wanted && direct_error_ > kRestOfLinks * state_.error;
        stage_ = Stage::direct;
    } else {
        begin_round();
    }
}

/// All that rays brought to a lumel in one half [lx].
glm::vec3 LinkRadiosity::indirect(std::size_t i, int half) const
{
    glm::vec3 sum(0.0f);
    std::uint32_t rays = 0;
    for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p) {
        rays += gathered_[half]->rays[p];
        sum += float(gathered_[half]->rays[p]) * received_[std::size_t(half)][p];
    }
    return rays > 0 ? sum / float(rays) : glm::vec3(0.0f);
}

/// Of one half [lx].
glm::vec3 LinkRadiosity::light(std::size_t i, int half, Parts parts) const
{
    glm::vec3 indirect(0.0f), sky(0.0f);
    std::uint32_t rays = 0;
    const Gathered& gathered = *gathered_[half];
    const std::vector<glm::vec3>& received = received_[std::size_t(half)];
    for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p) {
        rays += gathered.rays[p];
        sky += gathered.sky[p];
        if (!received.empty())
            indirect += float(gathered.rays[p]) * received[p];
    }
    const float share = rays > 0 ? 1.0f / float(rays) : 0.0f;
    const glm::vec3 direct = direct_->half(half)[i];
    if (parts == Parts::direct)
        return direct + share * sky;
    if (parts == Parts::indirect)
        return share * (indirect - sky);
    return direct + share * indirect;
}

/// The difference of two independent halves has four times the variance of their mean.
void LinkRadiosity::estimate()
{
    std::vector<glm::vec3> mean;
    std::vector<double> square, of_direct;
    for (std::size_t i = 0; i < lumels_.lumels.size(); ++i) {
        if (lumels_.lumels[i].flags & kLumelBuried)
            continue;
        const glm::vec3 a = light(i, 0, parts_wanted_), b = light(i, 1, parts_wanted_);
        const glm::vec3 d = 0.5f * (a - b);
        const glm::vec3 direct = 0.5f * (direct_->half(0)[i] - direct_->half(1)[i]);
        mean.push_back(0.5f * (a + b));
        square.push_back(double(glm::dot(d, d)));
        of_direct.push_back(double(glm::dot(direct, direct)));
    }
    const auto brightness = [](const glm::vec3& light) {
        return double(light.r + light.g + light.b);
    };
    double sum = 0.0;
    for (const glm::vec3& light : mean)
        sum += brightness(light);
    mean_light_ = sum / double(std::max<std::size_t>(mean.size(), 1));
    const double count = double(mean.size());
    // √(Σ d² / 3n) / (Σ H / 3n)
    const auto relative = [](double squares, double lights, double n) {
        return lights > 0.0 ? std::sqrt(3.0 * n * squares) / lights : 0.0;
    };
    state_.error = relative(std::accumulate(square.begin(), square.end(), 0.0), sum, count);
    direct_error_ = relative(std::accumulate(of_direct.begin(), of_direct.end(), 0.0), sum, count);
    double dark_squares = 0.0, dark_sum = 0.0, dark_count = 0.0;
    for (std::size_t k = 0; k < mean.size(); ++k)
        if (brightness(mean[k]) < kDark * sum / count) {
            dark_squares += square[k];
            dark_sum += brightness(mean[k]);
            dark_count += 1.0;
        }
    state_.dark_error = relative(dark_squares, dark_sum, dark_count);
}

std::vector<glm::vec3> LinkRadiosity::irradiance()
{
    std::vector<glm::vec3> result(lumels_.lumels.size(), glm::vec3(0.0f));
    if (direct_)
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = 0.5f * (light(i, 0, parts_wanted_) + light(i, 1, parts_wanted_));
    return result;
}

}  // namespace lumel
