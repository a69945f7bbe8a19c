// The deviation of lumels by that of their neighbours: on their chart, not on other surfaces.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../../support/source_folder.h"
#include "atlas/cells/order.h"
#include "atlas/prepare/solve_scene.h"
#include "links/direct/deviation.h"

namespace lumel {
namespace {

/// A room and the order of its lumels in space, in which walls follow each other.
struct Room {
    SolveScene scene{support::source_path("scenes/cornell-box.gltf"), {.size = 64}};
    std::vector<std::uint32_t> order =
        order_in_space(WorldLumels(scene.scene, scene.rays, scene.lumels));

    const std::vector<Lumel>& lumels() const { return scene.lumels.lumels; }
    std::vector<double> deviation(const std::vector<double>& square, double own,
                                  NearReach reach = kIndirectReach) const
    {
        return deviation_nearby(square, scene.lumels, order, reach, own);
    }
};

TEST(Deviation, OfOneChartTellsNothingOfOthers)
{
    const Room room;
    // The chart with the most lumels.
    std::vector<std::size_t> size(room.lumels().size() + 1, 0);
    for (const Lumel& lumel : room.lumels())
        ++size[lumel.chart];
    const auto noisy = std::uint32_t(std::ranges::max_element(size) - size.begin());
    std::vector<double> square;
    for (const Lumel& lumel : room.lumels())
        square.push_back(lumel.chart == noisy ? 4.0 : 0.0);
    const std::vector<double> deviation = room.deviation(square, 0.0);
    // A few are alone among buried lumels.
    std::size_t lumels = 0, mixed = 0;
    for (std::size_t i = 0; i < square.size(); ++i)
        if (size[room.lumels()[i].chart] > 16) {
            ++lumels;
            mixed += deviation[i] != std::sqrt(square[i]) ? 1 : 0;
        }
    EXPECT_LT(mixed, lumels / 500);
}

/// One noisy lumel counts for its neighbours, not for itself.
TEST(Deviation, OfOneLumelIsThatOfItsNeighbours)
{
    const Room room;
    constexpr std::size_t kWide = 2 * kIndirectReach.most + 1, kWithin = kWide * kWide - 1;
    const std::size_t count = room.lumels().size();
    std::size_t checked = 0;
    for (std::uint32_t i = 0; i < count; i += 97) {
        std::vector<double> square(count, 0.0);
        square[i] = double(kWithin);
        const std::vector<double> alone = room.deviation(square, 0.0),
                                  own = room.deviation(square, 1.0);
        EXPECT_EQ(alone[i], 0.0);
        EXPECT_GT(own[i], 0.0);
        const auto others =
            std::size_t(std::ranges::count_if(alone, [](double d) { return d > 0; }));
        if (others < kWithin)
            continue;  // at the rim
        ++checked;
        EXPECT_EQ(others, kWithin);
        for (std::size_t j = 0; j < alone.size(); ++j)
            if (alone[j] > 0.0) {
                EXPECT_EQ(room.lumels()[j].chart, room.lumels()[i].chart);
                EXPECT_GE(alone[j], 1.0);
            }
    }
    EXPECT_GT(checked, 3u);
}

/// Where few rays found a light, some neighbours have none. One lumel in 50 has a square of 50:
/// their mean is 1 for all, but none is within two texels of most.
TEST(Deviation, IsOfMoreNeighboursWhereFewTellIt)
{
    const Room room;
    std::vector<double> square;
    for (const Lumel& lumel : room.lumels())
        square.push_back(lumel.texel % 50 == 0 ? 50.0 : 0.0);
    const auto share_without = [&](NearReach reach) {
        const std::vector<double> deviation = room.deviation(square, 0.0, reach);
        return double(std::ranges::count(deviation, 0.0)) / double(deviation.size());
    };
    EXPECT_GT(share_without({2, 2}), 0.4);
    EXPECT_LT(share_without({2, 5}), 0.15);  // rims and corners
    // Where all tell it, more of them are asked only where a rim leaves too few.
    std::ranges::transform(room.lumels(), square.begin(),
                           [](const Lumel& lumel) { return 1.0 + 0.1 * (lumel.texel % 3); });
    const std::vector<double> near = room.deviation(square, 0.0, {2, 2}),
                              wider = room.deviation(square, 0.0, {2, 5});
    std::size_t apart = 0;
    for (std::size_t i = 0; i < near.size(); ++i)
        apart += near[i] != wider[i] ? 1 : 0;
    EXPECT_LT(apart, near.size() / 10);
}

}  // namespace
}  // namespace lumel
