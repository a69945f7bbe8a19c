#include "links/kept/ray_guide.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Shares of rays that follow the light, of which the best is taken. The others are drawn evenly,
/// so that no weight is above 1 / (1 - share).
constexpr std::array kShares = {0.5, 0.75};
/// Least variance of a ray, relative to the square of the mean: smoother light has little noise, as
/// rays are stratified.
constexpr double kUneven = 0.25;
/// Largest gain that is stated.
constexpr double kMaxGain = 1e3;
/// Maximum variance relative to that of even rays.
constexpr double kHelps = 0.85;

/// Each bin's neighbours count too: few rays meet a bin, and lumels of a group see light at
/// slightly different places. Azimuths, the columns, wrap around.
template <class Bins>
Bins smooth(const Bins& in)
{
    constexpr std::uint32_t side = RayGuide::kSide;
    Bins rows{}, both{};
    for (std::uint32_t r = 0; r < side; ++r)
        for (std::uint32_t c = 0; c < side; ++c)
            rows[r * side + c] =
                0.5 * in[r * side + c] + 0.25 * (in[(r > 0 ? r - 1 : r) * side + c] +
                                                 in[(r + 1 < side ? r + 1 : r) * side + c]);
    for (std::uint32_t r = 0; r < side; ++r)
        for (std::uint32_t c = 0; c < side; ++c)
            both[r * side + c] =
                0.5 * rows[r * side + c] +
                0.25 * (rows[r * side + (c + side - 1) % side] + rows[r * side + (c + 1) % side]);
    return both;
}

}  // namespace

std::uint32_t RayGuide::bin_of(const glm::vec2& point)
{
    const auto at = [](float x) { return std::min(std::uint32_t(x * float(kSide)), kSide - 1); };
    return at(point.x) * kSide + at(point.y);
}

bool RayGuide::fits(std::size_t lumels) const
{
    const auto is_sound = [](const Chances& of) {
        std::uint32_t sum = 0;
        for (const std::uint16_t chance : of)
            sum += chance;
        return sum == kAll && std::ranges::find(of, 0) == of.end();
    };
    return group.size() == (chances.empty() ? 0 : lumels) && gain.size() == chances.size() &&
           std::ranges::all_of(gain, [](float g) { return g >= 1.0f && g <= float(kMaxGain); }) &&
           std::ranges::all_of(group, [&](std::uint32_t g) { return g < chances.size(); }) &&
           std::ranges::all_of(chances, is_sound);
}

GuidedDraw::GuidedDraw(const RayGuide::Chances& chances) : chances_(chances)
{
    rows_[0] = 0;
    for (std::uint32_t r = 0; r < RayGuide::kSide; ++r) {
        rows_[r + 1] = rows_[r];
        for (std::uint32_t c = 0; c < RayGuide::kSide; ++c)
            rows_[r + 1] += chances[r * RayGuide::kSide + c];
    }
}

GuidedDraw::Drawn GuidedDraw::operator()(const glm::vec2& uniform) const
{
    constexpr std::uint32_t side = RayGuide::kSide;
    const float x = uniform.x * float(RayGuide::kAll);
    std::uint32_t row = 0;
    while (row + 1 < side && x >= float(rows_[row + 1]))
        ++row;
    const float in_row = float(rows_[row + 1] - rows_[row]);
    const float y = uniform.y * in_row;
    std::uint32_t column = 0, before = 0;
    while (column + 1 < side && y >= float(before + chances_[row * side + column]))
        before += chances_[row * side + column++];
    const std::uint32_t bin = row * side + column;
    const auto point = [](std::uint32_t of, float inside) {
        return std::min((float(of) + inside) / float(side), 0x1.fffffep-1f);
    };
    return {{point(row, (x - float(rows_[row])) / in_row),
             point(column, (y - float(before)) / float(chances_[bin]))},
            bin};
}

void GuideMoments::add(std::size_t k, std::uint32_t bin, double light)
{
    square_[k][bin] += light * light;
    light_[k] += light;
    rays_[k] += 1.0;
}

/// The variance of Σ f / p is least for p ∝ √E f².
RayGuide::Chances GuideMoments::chances_for(const Bins& square, double share)
{
    Bins root = smooth(square);
    double sum = 0.0;
    for (double& bin : root)
        sum += bin = std::sqrt(bin);
    RayGuide::Chances chances;
    double running = 0.0;
    std::uint32_t before = 0;
    for (std::uint32_t b = 0; b < RayGuide::kBins; ++b) {
        running += (1.0 - share) / RayGuide::kBins + share * root[b] / sum;
        const auto now = b + 1 < RayGuide::kBins
                             ? std::uint32_t(std::lround(running * RayGuide::kAll))
                             : RayGuide::kAll;
        chances[b] = std::uint16_t(now - before);
        before = now;
    }
    return chances;
}

/// Second moment of the rays of a solution with these chances, less the square of the mean.
double GuideMoments::variance(std::size_t k, const RayGuide::Chances& chances) const
{
    double square = 0.0;
    for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
        square += square_[k][b] * double(RayGuide::weight(chances[b]));
    const double mean = light_[k] / rays_[k];
    return square / rays_[k] - mean * mean;
}

std::optional<GuideMoments::Found> GuideMoments::find() const
{
    const std::size_t solutions = square_.size();
    Bins all{};
    for (std::size_t k = 0; k < solutions; ++k) {
        if (!(light_[k] > 0.0))
            return std::nullopt;
        for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
            all[b] += square_[k][b];
    }
    RayGuide::Chances even;
    even.fill(std::uint16_t(RayGuide::kEven));
    double now = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < solutions; ++k) {
        now += variance(k, even);
        squares += std::pow(light_[k] / rays_[k], 2.0);
    }
    if (now < kUneven * squares)
        return std::nullopt;
    double least = kHelps * now;
    double best = 0.0;
    for (const double share : kShares) {
        double sum = 0.0;
        for (std::size_t k = 0; k < solutions; ++k) {
            Bins others = all;
            for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
                others[b] = std::max(others[b] - square_[k][b], 0.0);
            sum += variance(k, chances_for(others, share));
        }
        if (sum > 0.0 && sum < least) {
            least = sum;
            best = share;
        }
    }
    if (!(best > 0.0))
        return std::nullopt;
    return Found{chances_for(all, best), float(std::min(now / least, kMaxGain))};
}

}  // namespace lumel
