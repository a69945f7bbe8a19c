// Bounces solved over links, against the equation that they solve.

#include <algorithm>
#include <cmath>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include "../../support/source_folder.h"
#include "traced_scene.h"

namespace lumel {
namespace {

using Light = std::vector<glm::dvec3>;

/// A furnished room, in which sub-lumels of few rays are lit by some rounds alone.
struct TracedRoom : support::TracedScene {
    TracedRoom() : TracedScene(support::source_path("scenes/room.gltf"), AtlasOptions{.size = 128})
    {
    }

    /// Adds a round of links, then finds all bounces.
    void add_round(std::uint16_t rays, const RayGuide* guide = nullptr)
    {
        trace(rays, guide);
        factor = solver.solve(links, source, 1e-3, received, factor).factor;
    }

    std::vector<glm::vec3> received;  ///< [P] [lx]
    double factor = 0.0;              ///< between changes of sweeps
};

/// A link from a sub-lumel to another. is_near: reflected beside `from` before.
struct Link {
    std::uint32_t from, to;
    glm::dvec3 weight;
    bool is_near;
};

std::vector<Link> links_of(const TracedRoom& room)
{
    std::vector<Link> all;
    const auto add = [&](std::uint32_t from, LinkEnd end, const glm::dvec3& weight, bool is_near) {
        if (room.numbers.is_part(end.number()))
            all.push_back({from, room.numbers.part(end.number()), weight, is_near});
    };
    for (const std::vector<LinkBlock>& round : room.links.rounds)
        for (std::size_t b = 0; b < round.size(); ++b) {
            std::size_t slot = 0, left = 0, near = 0;
            for (std::size_t n = 0; n < round[b].rays.size(); ++n) {
                const std::uint32_t lumel = room.work.order[b * kLinkBlock + n];
                for (std::size_t k = 0; k < round[b].rays[n]; ++k, ++slot) {
                    const std::uint32_t cell =
                        room.parts.has_hidden(lumel) ? round[b].from[left++] : 0u;
                    const std::uint32_t from = room.parts.part(lumel, cell);
                    const double of_ray =
                        round[b].weights.empty() ? 1.0 : double(round[b].weights[slot]);
                    const std::vector<NearLink>& by_slot = round[b].near;
                    if (near < by_slot.size() && by_slot[near].slot == slot) {
                        add(from, by_slot[near].end,
                            of_ray * glm::dvec3(glm::unpackF3x9_E1x5(by_slot[near].packed_weight)),
                            true);
                        ++near;
                    } else {
                        add(from, round[b].ends[slot], glm::dvec3(of_ray), false);
                    }
                }
            }
        }
    return all;
}

/// C + K ρ X of each sub-lumel: the mean over its rays of what they meet. One without rays is dark.
Light swept(const TracedRoom& room, const std::vector<Link>& links, const Light& light)
{
    Light sum(room.source.light.begin(), room.source.light.end());
    for (const Link& link : links)
        sum[link.from] += link.weight *
                          glm::dvec3(room.work.lumels()[room.parts.lumel(link.to)].albedo) *
                          light[link.to];
    const std::vector<float>& rays = room.source.rays;
    for (std::size_t p = 0; p < sum.size(); ++p)
        sum[p] = rays[p] > 0 ? sum[p] / double(rays[p]) : glm::dvec3(0.0);
    return sum;
}

/// Deviation of the light from the limit of the sweeps [RMS], each sub-lumel's in terms of its own
/// light; those darker than a ten-thousandth of the mean count as that bright.
double distance_from_limit(const TracedRoom& room)
{
    constexpr int kSweeps = 200;  // albedo 0.8 to its 200th power is 4e-20
    constexpr double kDarkest = 1e-4;
    const auto sum_of = [](const glm::dvec3& light) { return light.r + light.g + light.b; };
    Light limit(room.received.begin(), room.received.end());
    const std::vector<Link> links = links_of(room);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        limit = swept(room, links, limit);
    double mean = 0.0, squares = 0.0;
    for (const glm::dvec3& light : limit)
        mean += sum_of(light) / double(limit.size());
    EXPECT_GT(mean, 0.0);
    std::size_t count = 0;
    for (std::size_t p = 0; p < limit.size(); ++p)
        if (room.source.rays[p] > 0 && sum_of(limit[p]) > 0.0) {
            squares += std::pow(sum_of(glm::dvec3(room.received[p]) - limit[p]) /
                                    (sum_of(limit[p]) + kDarkest * mean),
                                2.0);
            ++count;
        }
    return std::sqrt(squares / double(count));
}

TEST(LinkSolver, SolvesLaterRoundsAsWellAsTheFirst)
{
    constexpr double kSolved = 5e-3;  // a first round ends here, at an estimated 1e-3
    TracedRoom room;
    for (const int rays : {8, 8, 16, 32}) {
        room.factor = 0.0;
        room.add_round(std::uint16_t(rays));
        EXPECT_LE(distance_from_limit(room), kSolved) << "round " << room.links.rounds.size();
    }
}

TEST(LinkSolver, SolvesFromTheLightOfOtherLinks)
{
    constexpr double kSolved = 5e-3;
    TracedRoom room;
    room.add_round(8);
    for (int other = 0; other < 3; ++other) {
        room.links = LinkTable(room.parts.count());
        room.add_round(8);
        EXPECT_LE(distance_from_limit(room), kSolved) << "links " << other;
    }
}

TEST(LinkSolver, SolvesRoundsOfWeightedLinks)
{
    constexpr double kSolved = 5e-3;
    TracedRoom room;
    const RayGuide guide = room.striped_guide();
    room.add_round(16);
    room.add_round(16, &guide);
    EXPECT_LE(distance_from_limit(room), kSolved);
}

/// Otherwise light would grow from sweep to sweep in a gap between bright walls.
TEST(LinkSolver, TakesNoMoreThanAllRaysFromBesideASubLumel)
{
    TracedRoom room;
    // Three quarters of the rays go to a sixteenth of the directions; others weigh 2.6.
    constexpr std::uint16_t kMany = 3076, kFew = 68;
    RayGuide guide = room.striped_guide();
    for (RayGuide::OfSolution& of : guide.tables[1])
        for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
            of.probabilities[b] = b < RayGuide::kSide ? kMany : kFew;
    room.add_round(4);
    room.add_round(20, &guide);
    std::vector<glm::dvec3> beside(room.parts.count(), glm::dvec3(0.0));
    std::vector<double> rays(room.parts.count(), 0.0);
    for (const Link& link : links_of(room)) {
        rays[link.from] += 1.0;
        if (link.is_near)
            beside[link.from] += link.weight;
    }
    std::size_t above = 0;
    for (std::size_t p = 0; p < beside.size(); ++p) {
        const double most = std::max({beside[p].r, beside[p].g, beside[p].b});
        EXPECT_LE(most, double(room.source.rays[p]) * (1.0 + 1e-5)) << "sub-lumel " << p;
        above += most > rays[p] ? 1 : 0;
    }
    EXPECT_GT(above, 0u) << "no weights of rays were too many";
}

}  // namespace
}  // namespace lumel
