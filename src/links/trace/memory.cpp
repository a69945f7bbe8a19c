// LinkRadiosity's memory, planned before the start.

#include <algorithm>

#include "base/core/usage.h"
#include "base/ranks/rank_blocks.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

/// Rays per lumel in all solutions for an estimated error of 5 %: 24 in Cornell's box, 34 in
/// Sponza, 74 in the town of scenes/town.py.
constexpr double kLikelyRays = 64.0;
/// [bytes] of a lumel per round and solution: number of its links.
constexpr double kRowBytes = sizeof(std::uint16_t);
/// [bytes] of a ray that may be guided: its bin; of a guided lumel, also its weight.
constexpr double kBinBytes = sizeof(std::uint8_t), kWeightBytes = sizeof(float);
/// [bytes] of a ray where lamps are kept apart: its shares. A tenth of the rays is near, with two
/// to four shares each; maximum seen.
constexpr double kShareBytes = 0.4 * double(sizeof(NearShare));
/// [bytes] of a lumel's guide, which 32 lumels or more share, except small groups.
constexpr double kGuideBytes = sizeof(std::uint32_t) + sizeof(RayGuide::Table) / 32.0;
/// Fraction of lumels with direct light per cell: maximum seen.
constexpr double kVarying = 0.1;
/// Fraction of lumels with direct light per lamp and cell, maximum seen with sixteen lamps; both
/// the old and the new light are in memory while a pass replaces it.
constexpr double kVaryingByLamp = 2 * 0.5;
constexpr double kShareOfFree = 0.5;
/// GPU memory of a ray in the first round, and with the weights of later ones, and the gaps in
/// slices: 6 and 9 in the Cornell box, 6 and 13 in two rooms, 9 and 16 in a furnished one [bytes].
constexpr double kDeviceLinkBytes = 6.0, kDeviceGuidedLinkBytes = 13.0;

}  // namespace

std::uint64_t free_bytes_for_links()
{
    return std::uint64_t(kShareOfFree * double(available_memory_bytes()));
}

std::uint64_t LinkRadiosity::first_bytes(std::size_t lumels, std::uint32_t even_rays,
                                         std::size_t lamps)
{
    const double rays = even_rays > 0 ? double(even_rays) : double(kSolutions * kFirstRays);
    const double of_ray =
        kLinkBytes + (even_rays > 0 ? 0.0 : kBinBytes) + (lamps > 0 ? kShareBytes : 0.0);
    return std::uint64_t(double(lumels) * (rays * of_ray + kSolutions * kRowBytes));
}

std::uint64_t LinkRadiosity::likely_bytes(std::size_t lumels, std::uint64_t shots,
                                          std::size_t lamps)
{
    constexpr double kFirst = kSolutions * kFirstRays;
    const double rays = shots > 0 ? std::min(double(shots), kLikelyRays) : kLikelyRays;
    double rounds = 1.0;
    for (double traced = kFirst; traced < rays; traced *= 1.0 + kMinAdded)
        ++rounds;
    // Guides are not everywhere: as many rays have weights as follow the first round.
    return std::uint64_t(double(lumels) *
                         (rays * (kLinkBytes + (lamps > 0 ? kShareBytes : 0.0)) + rays * kBinBytes +
                          (rays - std::min(rays, kFirst)) * kWeightBytes +
                          rounds * kSolutions * kRowBytes));
}

std::uint64_t LinkRadiosity::host_bytes(std::size_t lumels, std::size_t pieces, std::size_t texels,
                                        std::size_t lamps)
{
    constexpr std::size_t kOfSources = sizeof(glm::vec3) + sizeof(float);
    constexpr std::size_t kOfMean = 2 * sizeof(glm::vec3) + sizeof(glm::vec2) + 2 * sizeof(float);
    constexpr std::size_t kOfOrder = sizeof(std::uint32_t), kOfGroups = sizeof(std::uint32_t),
                          kOfNoise = sizeof(std::uint32_t);
    const std::size_t of_parts =
        kSolutions * (kOfSources + sizeof(glm::vec3)) + kOfGroups + sizeof(glm::vec3);
    constexpr std::size_t kPasses = 8;  // of direct light, a byte each
    constexpr std::size_t kOfRays = kSolutions * sizeof(std::uint16_t);
    const std::size_t of_lumels =
        sizeof(WorldLumel) + kOfOrder + kOfNoise + 2 * kOfMean + kOfRays + kPasses;
    const auto varying = std::size_t(kVarying * double(lumels)),
               by_lamp = std::size_t(kVaryingByLamp * double(lumels));
    return lumels * (of_lumels + of_parts) + pieces * (sizeof(Piece) + sizeof(Facet)) +
           Cells::bytes(lumels) + SubLumels::bytes(lumels, lumels) +
           DirectEstimator::bytes(lumels, varying, lamps, by_lamp) + NearLumels::bytes(texels) +
           ChartFilter::bytes(lumels, texels);
}

std::uint64_t LinkRadiosity::sweep_bytes(std::size_t lumels)
{
    const std::uint64_t sweep = lumels * (4 * sizeof(glm::vec4) + sizeof(float));
    const std::uint64_t mean = lumels * (kSolutions * sizeof(glm::vec3) + sizeof(float)) +
                               ChartFilter::working_bytes(lumels);
    return std::max(sweep, mean);
}

std::uint64_t LinkRadiosity::device_sweep_bytes(std::size_t lumels, std::uint64_t shots)
{
    constexpr double kFirst = kSolutions * kFirstRays;
    const double rays = shots > 0 ? std::min(double(shots), kLikelyRays) : kLikelyRays;
    return DeviceSweeps::bytes(lumels) +
           std::uint64_t(double(lumels) * rays *
                         (rays > kFirst ? kDeviceGuidedLinkBytes : kDeviceLinkBytes));
}

std::uint64_t LinkRadiosity::lamp_bytes(std::size_t lumels, std::size_t lamps)
{
    if (lamps == 0)
        return 0;
    // Sweeps: reflected direct light and source term, light sent before and after, what sub-lumels
    // receive twice, the three solutions. Filter: lamps filtered together, beside the whole.
    constexpr std::size_t kSweeps =
        kLampLanes * (4 * sizeof(glm::vec4) + (2 + kSolutions) * sizeof(glm::vec3));
    const std::uint64_t filter =
        ChartFilter::working_bytes(lumels) + lumels * 4 * sizeof(FitLight<kFilteredTogether>);
    // Their means, and the light they become.
    const std::uint64_t light = lumels * (lamps * 2 + kSolutions) * sizeof(glm::vec3);
    return light + std::max(lumels * std::uint64_t(kSweeps), filter);
}

std::size_t LinkRadiosity::lumels_per_rank(std::size_t lumels, std::size_t ranks)
{
    const std::size_t blocks = (lumels + kLinkBlock - 1) / kLinkBlock;
    return std::min((blocks + ranks - 1) / ranks * kLinkBlock, lumels);
}

/// Further rays per lumel and solution that fit in memory, of all ranks.
double LinkRadiosity::rays_that_fit() const
{
    if (most_bytes_ == 0)
        return kMaxLinks;
    double taken = 0.0;
    for (const std::optional<LinkTable>& links : links_)
        taken += double(links->bytes());
    if (work_.ranks)
        taken = std::ranges::max(work_.ranks->all(taken));
    const auto all = double(work_.order.size()),
               lumels = double(lumels_per_rank(work_.order.size(), count_of(work_.ranks)));
    // The second round may give all rays weights.
    if (can_guide_ && round_ <= 1)
        taken += lumels * double(state_.shots) * kWeightBytes;
    const double of_ray =
        state_.shots > 0 ? taken / double(state_.shots) : lumels * (kLinkBytes + kBinBytes);
    const double rows = lumels * kSolutions * kRowBytes + all * kGuideBytes;
    return std::max(double(most_bytes_) - taken - rows, 0.0) / (kSolutions * of_ray);
}

}  // namespace lumel
