#include "links/sweeps/source_term.h"

#include <algorithm>
#include <array>

#include "base/core/parallel.h"
#include "base/core/precise.shared.h"
#include "links/kept/link_rows.h"

namespace lumel {
namespace {

/// Lumels per task.
constexpr std::size_t kSourcesPerTask = 4096;

/// Minimum distance of a hit [sides of the lumel]: lumels that touch other geometry there are in
/// contact anyway.
constexpr float kLeastDistance = 1e-3f;

/// [P] 1 for sub-lumels from which no ray was sent: what they receive is not known.
std::vector<char> unknown_parts(const LinkWork& work, const SubLumels& parts,
                                const LinkTable& links)
{
    std::vector<char> unknown(parts.count(), 0);
    for (std::size_t i = 0; i < work.order.size(); ++i)
        if (parts.has_hidden(i))
            std::fill(unknown.begin() + parts.first(i), unknown.begin() + parts.end(i), char(1));
    for_each_row(work, parts, links, [&](const LinkRow& row, std::uint32_t i) {
        if (parts.has_hidden(i))
            for (std::size_t k = 0; k < row.ends.size(); ++k)
                unknown[parts.first(i) + row.leaves(parts, i, k)] = 0;
    });
    share_rows(work, [&](auto& archive, std::uint32_t i) {
        for (std::uint32_t p = parts.first(i); parts.has_hidden(i) && p < parts.end(i); ++p)
            archive(unknown[p]);
    });
    return unknown;
}

}  // namespace

ReflectedLight::ReflectedLight(const LinkWork& work, const SubLumels& parts,
                               const LinkNumbers& numbers, const DirectEstimator& direct)
    : direct_(direct),
      of_number_(numbers.count())
{
    parallel_for(work.lumels().size(), kSourcesPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const glm::vec3& albedo = work.lumels()[i].albedo;
            const OfNumber light = direct.varies(i) ? OfNumber{albedo, direct.index_of_cells(i)}
                                                    : OfNumber{albedo * direct.mean(i)};
            std::fill(of_number_.begin() + numbers.of_part(parts.first(i)),
                      of_number_.begin() + numbers.of_part(parts.end(i)), light);
        }
    });
}

LampsReflected::LampsReflected(const LinkWork& work, const SubLumels& parts,
                               const LinkNumbers& numbers, const DirectEstimator& direct,
                               const LampTable& lamps, std::size_t first)
    : work_(work),
      parts_(parts),
      numbers_(numbers),
      direct_(direct),
      lamps_(lamps),
      first_(first),
      count_(std::min(kLampLanes, lamps.all.size() - first)),
      of_number_(numbers.count(), LaneLight<kLampLanes>{})
{
    parallel_for(work.lumels().size(), kSourcesPerTask, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            LaneLight<kLampLanes> light{};
            for (std::size_t lane = 0; lane < count_; ++lane)
                light[lane] =
                    glm::vec4(work.lumels()[i].albedo * direct.mean_of_lamp(i, first + lane), 0.0f);
            light[0].w = direct.varies_by_lamp(i) ? kVaries : 0.0f;
            std::fill(of_number_.begin() + numbers.of_part(parts.first(i)),
                      of_number_.begin() + numbers.of_part(parts.end(i)), light);
        }
    });
}

const LaneLight<kLampLanes>& LampsReflected::find_of_cell(LinkEnd end,
                                                          LaneLight<kLampLanes>& light) const
{
    const std::uint32_t lumel = parts_.lumel(numbers_.part(end.number()));
    const glm::vec3* const lamps = direct_.lamps_in(lumel, end.cell()) + first_;
    for (std::size_t lane = 0; lane < count_; ++lane)
        light[lane] = glm::vec4(work_.lumels()[lumel].albedo * lamps[lane], 0.0f);
    return light;
}

LaneLight<kLampLanes> LampsReflected::near(std::span<const NearShare> shares) const
{
    LaneLight<kLampLanes> sum{}, of_cells{};
    for (const NearShare& share : shares) {
        if (share.lamp == NearShare::kEveryLamp) {
            const LaneLight<kLampLanes>& light = at(share.at, of_cells);
            for (std::size_t lane = 0; lane < count_; ++lane)
                sum[lane] += glm::vec4(share.light, 0.0f) * light[lane];
        } else if (has(share.lamp)) {
            sum[share.lamp - first_] += glm::vec4(share.light, 0.0f);
        }
    }
    return sum;
}

LaneLight<kLampLanes> LampsReflected::of_sky(const glm::vec3& light) const
{
    LaneLight<kLampLanes> lanes{};
    if (has(lamps_.of_dim_sky))
        lanes[lamps_.of_dim_sky - first_] = glm::vec4(light, 0.0f);
    return lanes;
}

OutsideReflected::OutsideReflected(const LinkWork& work, const SubLumels& parts,
                                   const LinkNumbers& numbers, std::span<const glm::vec3> direct)
    : of_number_(numbers.count(), LaneLight<kLampLanes>{})
{
    parallel_for(work.lumels().size(), kSourcesPerTask, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            LaneLight<kLampLanes> light{};
            for (std::size_t lane = 0; lane < kLampLanes; ++lane)
                light[lane] =
                    glm::vec4(work.lumels()[i].albedo * direct[i * kLampLanes + lane], 0.0f);
            std::fill(of_number_.begin() + numbers.of_part(parts.first(i)),
                      of_number_.begin() + numbers.of_part(parts.end(i)), light);
        }
    });
}

LaneLight<kLampLanes> OutsideReflected::near(std::span<const NearShare> shares) const
{
    LaneLight<kLampLanes> sum{};
    for (const NearShare& share : shares)
        if (share.lamp == NearShare::kEveryLamp)
            for (std::size_t lane = 0; lane < kLampLanes; ++lane)
                sum[lane] += glm::vec4(share.light, 0.0f) * of_number_[share.at.number()][lane];
    return sum;
}

namespace {

/// Light of all sources together, as LampsReflected gives that of lamps.
struct AllReflected {
    const ReflectedLight& reflected;

    const LaneLight<1>& at(LinkEnd end, LaneLight<1>& light) const
    {
        light[0] = glm::vec4(reflected.at(end), 0.0f);
        return light;
    }
    LaneLight<1> of_sky(const glm::vec3& light) const { return {glm::vec4(light, 0.0f)}; }
};

LaneLight<1> near_light(const AllReflected&, const NearLight& near, std::span<const NearShare>)
{
    return {glm::vec4(near.light, 0.0f)};
}

LaneLight<kLampLanes> near_light(const LampsReflected& reflected, const NearLight&,
                                 std::span<const NearShare> shares)
{
    return reflected.near(shares);
}

LaneLight<kLampLanes> near_light(const OutsideReflected& reflected, const NearLight&,
                                 std::span<const NearShare> shares)
{
    return reflected.near(shares);
}

/// Walks through the near links of a row with their shares.
class NearLinks {
public:
    explicit NearLinks(const LinkRow& row) : row_(row) {}

    struct Near {
        LinkEnd end;
        glm::vec3 weight;
        const NearLight& light;
        std::span<const NearShare> shares;
    };
    Near next()
    {
        const std::size_t first = share_;
        const std::uint32_t index = row_.first_near + std::uint32_t(near_);
        while (share_ < row_.shares.size() && row_.shares[share_].near == index)
            ++share_;
        const std::size_t n = near_++;
        return {row_.near[n].end, row_.near[n].weight(), row_.near_light[n],
                row_.shares.subspan(first, share_ - first)};
    }

private:
    const LinkRow& row_;
    std::size_t near_ = 0, share_ = 0;
};

template <std::size_t Lanes, class Reflected>
SourceTerm sum_over_rays(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
                         const Reflected& reflected, const LinkTable& links)
{
    SourceTerm sum{std::vector<glm::vec4>(parts.count() * Lanes, glm::vec4(0.0f)),
                   std::vector<float>(parts.count(), 0.0f)};
    const std::vector<char> unknown = unknown_parts(work, parts, links);
    std::vector<char> loses(work.order.size(), 0);
    std::vector<float> returned(parts.count(), 0.0f);
    for_each_row(work, parts, links, [&](const LinkRow& row, std::uint32_t i) {
        const std::uint32_t first = parts.first(i);
        struct Count {
            float rays = 0.0f, weights = 0.0f, returned = 0.0f;
            bool is_all = true;
        };
        std::array<Count, kMaxParts> counts;
        NearLinks nears(row);
        LaneLight<Lanes> found{};
        for (std::size_t k = 0; k < row.ends.size(); ++k) {
            const std::uint32_t leaves = row.leaves(parts, i, k);
            const float weight = row.weight(k);
            LinkEnd end = row.ends[k];
            float passed = 0.0f;
            const bool is_near = end.number() == LinkNumbers::kNear;
            if (is_near) {
                const NearLinks::Near near = nears.next();
                end = near.end;
                passed = std::max({near.weight.r, near.weight.g, near.weight.b});
                found = near_light(reflected, near.light, near.shares);
            }
            if (numbers.is_part(end.number()) && unknown[numbers.part(end.number())]) {
                counts[leaves].is_all = false;
                continue;
            }
            if (!numbers.is_part(end.number()))
                loses[i] = 1;
            if (numbers.is_lost(end.number())) {
                counts[leaves].is_all = false;
                continue;
            }
            counts[leaves].rays += 1.0f;
            counts[leaves].weights += weight;
            if (numbers.is_part(end.number()))
                counts[leaves].returned += weight * passed;
            const LaneLight<Lanes>& light = is_near ? found : reflected.at(end, found);
            for (std::size_t lane = 0; lane < Lanes; ++lane)
                sum.light[(first + leaves) * Lanes + lane] +=
                    glm::vec4(weight * glm::vec3(light[lane]), 0.0f);
        }
        for (std::uint32_t p = first; p < parts.end(i); ++p) {
            const Count& count = counts[p - first];
            sum.rays[p] += count.is_all ? count.rays : count.weights;
            returned[p] += count.returned;
        }
    });
    // Weights of guided rays add up to their number only on average. In a narrow gap, where most
    // rays return, a larger sum would make light grow from sweep to sweep.
    for (std::size_t p = 0; p < parts.count(); ++p)
        sum.rays[p] = std::max(sum.rays[p], returned[p]);
    share_rows(work, [&](auto& archive, std::uint32_t i) {
        archive(loses[i]);
        for (std::uint32_t p = parts.first(i); p < parts.end(i); ++p)
            archive(sum.rays[p]);
    });
    for (std::size_t p = 0; p < parts.count(); ++p) {
        const LaneLight<Lanes> sky = reflected.of_sky(links.sky[p]);
        for (std::size_t lane = 0; lane < Lanes; ++lane)
            sum.light[p * Lanes + lane] =
                glm::vec4(without_tiny(glm::vec3(sum.light[p * Lanes + lane] + sky[lane])), 0.0f);
    }
    sum.is_closed = std::none_of(loses.begin(), loses.end(), [](char one) { return one != 0; });
    return sum;
}

}  // namespace

SourceTerm find_source_term(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, const ReflectedLight& reflected,
                            const LinkTable& links)
{
    return sum_over_rays<1>(work, parts, numbers, AllReflected{reflected}, links);
}

SourceTerm find_source_term(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, const LampsReflected& reflected,
                            const LinkTable& links)
{
    return sum_over_rays<kLampLanes>(work, parts, numbers, reflected, links);
}

SourceTerm find_source_term(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, const OutsideReflected& reflected,
                            const LinkTable& links)
{
    return sum_over_rays<kLampLanes>(work, parts, numbers, reflected, links);
}

/// Of far hits, the distance between the lumel's centre and the cell's: off by a side at most,
/// where hits are kNearSides away or more.
RayDistances find_distances(const LinkWork& work, const SubLumels& parts,
                            const LinkNumbers& numbers, std::span<const LinkTable* const> tables)
{
    const std::size_t count = work.lumels().size();
    RayDistances result{std::vector<float>(count, NearLight::kNoHit), std::vector<float>(count)};
    std::vector<std::uint32_t> rays(count, 0);
    const auto add = [&](std::uint32_t i, float distance, float weight) {
        result.nearest[i] = std::min(result.nearest[i], distance);
        result.inverse[i] += weight / distance;
    };
    for (const LinkTable* links : tables)
        for_each_row(work, parts, *links, [&](const LinkRow& row, std::uint32_t i) {
            const WorldLumel& lumel = work.world[i];
            rays[i] += std::uint32_t(row.ends.size());
            for (std::size_t k = 0; k < row.ends.size(); ++k) {
                const LinkEnd end = row.ends[k];
                if (!numbers.is_part(end.number()))
                    continue;
                const std::uint32_t j = parts.lumel(numbers.part(end.number()));
                const WorldLumel& hit = work.world[j];
                add(i,
                    std::max(glm::distance(lumel.centre, hit.centre) - 0.5f * hit.size,
                             kNearSides * std::max(lumel.size, hit.size)),
                    row.weight(k));
            }
            for (std::size_t n = 0; n < row.near.size(); ++n)
                add(i, std::max(row.near_light[n].distance, kLeastDistance * lumel.size),
                    row.weight(row.near[n].slot - row.first_slot));
        });
    for (std::size_t i = 0; i < count; ++i)
        result.inverse[i] /= float(std::max(rays[i], 1u));
    share_rows(work, [&](auto& archive, std::uint32_t i) {
        archive(result.nearest[i], result.inverse[i]);
    });
    return result;
}

}  // namespace lumel
