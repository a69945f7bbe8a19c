#include "links/kept/ray_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lumel {
namespace {

/// Shares of rays that follow the light, of which the best is taken. The others are uniform,
/// so that no weight is above 1 / (1 - share).
constexpr std::array kShares = {0.5, 0.75};
/// Least variance of a ray, relative to the square of the mean: smoother light has little noise, as
/// rays are stratified.
constexpr double kUneven = 0.25;
/// Largest gain that is stated.
constexpr double kMaxGain = 1e3;
/// Maximum variance relative to that of uniform rays.
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

RayGuide::OfSolution RayGuide::uniform()
{
    OfSolution uniform;
    uniform.probabilities.fill(std::uint16_t(kUniform));
    return uniform;
}

std::uint32_t RayGuide::bin_of(const glm::vec2& point)
{
    const auto at = [](float x) { return std::min(std::uint32_t(x * float(kSide)), kSide - 1); };
    return at(point.x) * kSide + at(point.y);
}

bool RayGuide::fits(std::size_t lumels) const
{
    const auto is_sound = [](const OfSolution& of) {
        return std::accumulate(of.probabilities.begin(), of.probabilities.end(), 0u) == kOne &&
               std::ranges::find(of.probabilities, 0) == of.probabilities.end() &&
               of.gain >= 1.0f && of.gain <= float(kMaxGain);
    };
    const auto are_sound = [&](const Table& table) { return std::ranges::all_of(table, is_sound); };
    return group.size() == (tables.empty() ? 0 : lumels) &&
           std::ranges::all_of(group, [&](std::uint32_t g) { return g < tables.size(); }) &&
           std::ranges::all_of(tables, are_sound);
}

GuidedDraw::GuidedDraw(const RayGuide::Probabilities& probabilities) : probabilities_(probabilities)
{
    rows_[0] = 0;
    for (std::uint32_t r = 0; r < RayGuide::kSide; ++r) {
        rows_[r + 1] = rows_[r];
        for (std::uint32_t c = 0; c < RayGuide::kSide; ++c)
            rows_[r + 1] += probabilities[r * RayGuide::kSide + c];
    }
}

GuidedDraw::Drawn GuidedDraw::operator()(const glm::vec2& uniform) const
{
    constexpr std::uint32_t side = RayGuide::kSide;
    const float x = uniform.x * float(RayGuide::kOne);
    std::uint32_t row = 0;
    while (row + 1 < side && x >= float(rows_[row + 1]))
        ++row;
    const float in_row = float(rows_[row + 1] - rows_[row]);
    const float y = uniform.y * in_row;
    std::uint32_t column = 0, before = 0;
    while (column + 1 < side && y >= float(before + probabilities_[row * side + column]))
        before += probabilities_[row * side + column++];
    const std::uint32_t bin = row * side + column;
    const auto point = [](std::uint32_t of, float inside) {
        return std::min((float(of) + inside) / float(side), 0x1.fffffep-1f);
    };
    return {{point(row, (x - float(rows_[row])) / in_row),
             point(column, (y - float(before)) / float(probabilities_[bin]))},
            bin};
}

void GuideMoments::add(std::size_t k, std::uint32_t bin, double light)
{
    square_[k][bin] += light * light;
    light_[k] += light;
    rays_[k] += 1.0;
}

/// The variance of Σ f / p is least for p ∝ √E f².
RayGuide::Probabilities GuideMoments::probabilities_for(const Bins& square, double share)
{
    Bins root = smooth(square);
    double sum = 0.0;
    for (double& bin : root)
        sum += bin = std::sqrt(bin);
    RayGuide::Probabilities probabilities;
    double running = 0.0;
    std::uint32_t before = 0;
    for (std::uint32_t b = 0; b < RayGuide::kBins; ++b) {
        running += (1.0 - share) / RayGuide::kBins + share * root[b] / sum;
        const auto now = b + 1 < RayGuide::kBins
                             ? std::uint32_t(std::lround(running * RayGuide::kOne))
                             : RayGuide::kOne;
        probabilities[b] = std::uint16_t(now - before);
        before = now;
    }
    return probabilities;
}

/// Second moment of the rays of a solution with these probabilities, less the square of the mean.
double GuideMoments::variance(std::size_t k, const RayGuide::Probabilities& probabilities) const
{
    double square = 0.0;
    for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
        square += square_[k][b] * double(RayGuide::weight(probabilities[b], 0.0f, 1.0f));
    const double mean = light_[k] / rays_[k];
    return square / rays_[k] - mean * mean;
}

/// For the rays of a solution: each of the others tells what the other's rays gain.
RayGuide::OfSolution GuideMoments::learn(std::size_t i, std::size_t j) const
{
    const RayGuide::OfSolution uniform = RayGuide::uniform();
    const double now = variance(i, uniform.probabilities) + variance(j, uniform.probabilities);
    const double squares =
        std::pow(light_[i] / rays_[i], 2.0) + std::pow(light_[j] / rays_[j], 2.0);
    if (!(light_[i] > 0.0) || !(light_[j] > 0.0) || now < kUneven * squares)
        return uniform;
    Bins both = square_[i];
    for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
        both[b] += square_[j][b];
    RayGuide::OfSolution best = uniform;
    double least = kHelps * now;
    for (const double share : kShares) {
        const double guided = variance(i, probabilities_for(square_[j], share)) +
                              variance(j, probabilities_for(square_[i], share));
        if (guided > 0.0 && guided < least) {
            least = guided;
            best = {probabilities_for(both, share), float(std::min(now / guided, kMaxGain))};
        }
    }
    return best;
}

std::optional<RayGuide::Table> GuideMoments::find() const
{
    RayGuide::Table table;
    for (std::size_t k = 0; k < kSolutions; ++k)
        table[k] = learn((k + 1) % kSolutions, (k + 2) % kSolutions);
    const auto is_uniform = [](const RayGuide::OfSolution& of) { return of.gain == 1.0f; };
    return std::ranges::all_of(table, is_uniform) ? std::nullopt : std::optional(table);
}

}  // namespace lumel
