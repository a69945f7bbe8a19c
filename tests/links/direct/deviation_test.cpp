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
    std::vector<double> deviation(const std::vector<double>& square, double own) const
    {
        return deviation_nearby(square, scene.lumels, order, kIndirectReach, own);
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
    constexpr std::size_t kWithin = (2 * kIndirectReach + 1) * (2 * kIndirectReach + 1) - 1;
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

}  // namespace
}  // namespace lumel
