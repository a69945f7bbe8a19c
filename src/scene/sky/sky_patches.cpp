// [Tre87]: seven rows of 12° and a cap of 6° about the zenith. The first patch of each row has its
// middle in the north, and patches follow clockwise.

#include "scene/sky/sky_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lumel {
namespace {

constexpr std::array<std::size_t, 7> kPatchesOfRow = {30, 30, 24, 24, 18, 12, 6};
constexpr double kRowHeight = std::numbers::pi / 15.0;  // 12°
constexpr double kTurn = 2.0 * std::numbers::pi;
/// Points along a side of a patch, for means.
constexpr int kMeanPoints = 3;

}  // namespace

SkyPatches::SkyPatches(std::size_t division)
{
    std::uint32_t first_whole = 0;
    for (std::size_t row = 0; row < kPatchesOfRow.size(); ++row) {
        const std::size_t wholes = kPatchesOfRow[row], count = wholes * division;
        const double width = kTurn / double(count), from = -0.5 * kTurn / double(wholes);
        for (std::size_t part = 0; part < division; ++part) {
            const auto elevation = [&](std::size_t k) {
                return kRowHeight * (double(row) + double(k) / double(division));
            };
            rows_.push_back({elevation(part + 1), patches_.size(), count, from});
            for (std::size_t k = 0; k < count; ++k)
                patches_.push_back({std::sin(elevation(part)), std::sin(elevation(part + 1)),
                                    from + width * double(k), width,
                                    first_whole + std::uint32_t(k / division)});
        }
        first_whole += std::uint32_t(wholes);
    }
    rows_.push_back({0.5 * std::numbers::pi, patches_.size(), 1, 0.0});
    patches_.push_back({patches_.back().high, 1.0, 0.0, kTurn, first_whole});
}

std::uint32_t SkyPatches::at(const glm::vec3& direction) const
{
    if (!(direction.y > 0.0f))
        return kNone;
    const double elevation = std::asin(std::min(double(direction.y), 1.0));
    const auto row = std::min(std::upper_bound(rows_.begin(), rows_.end(), elevation,
                                               [](double at, const Row& r) { return at < r.top; }),
                              rows_.end() - 1);
    double turned = std::atan2(double(direction.x), -double(direction.z)) - row->from;
    turned -= kTurn * std::floor(turned / kTurn);
    const auto column = std::size_t(turned / kTurn * double(row->count));
    return std::uint32_t(row->first + std::min(column, row->count - 1));
}

double SkyPatches::solid_angle(std::size_t patch) const
{
    const Patch& is = patches_[patch];
    return is.width * (is.high - is.low);
}

double SkyPatches::projected(std::size_t patch) const
{
    const Patch& is = patches_[patch];
    return 0.5 * is.width * (is.high * is.high - is.low * is.low);
}

/// Points in the middle of parts of equal solid angle.
std::vector<double> SkyPatches::means(const std::function<double(const glm::dvec3&)>& of) const
{
    std::vector<double> means;
    means.reserve(count());
    for (const Patch& patch : patches_) {
        double sum = 0.0;
        for (int i = 0; i < kMeanPoints; ++i)
            for (int j = 0; j < kMeanPoints; ++j) {
                const double up =
                    patch.low + (patch.high - patch.low) * (double(i) + 0.5) / kMeanPoints;
                const double azimuth = patch.from + patch.width * (double(j) + 0.5) / kMeanPoints;
                const double level = std::sqrt(1.0 - up * up);
                sum += of({level * std::sin(azimuth), up, -level * std::cos(azimuth)});
            }
        means.push_back(sum / (kMeanPoints * kMeanPoints));
    }
    return means;
}

}  // namespace lumel
