#pragma once
// Links whose rays are cast by a device, against those of the host, in four rooms.

#include <array>
#include <cstdio>

#include "../../jobs/solved.h"
#include "rooms.h"

namespace lumel::support {

struct ComparedRoom {
    const char* name;
    SolveScene (*prepare)();
};

inline const std::array kComparedRooms = {
    ComparedRoom{"cornell_box", [] { return SolveScene(scene_path("cornell-box"), {.size = 64}); }},
    ComparedRoom{"two_rooms", [] { return SolveScene(scene_path("two-rooms"), {.size = 64}); }},
    ComparedRoom{"furnished", [] { return SolveScene(scene_path("room"), {.size = 96}); }},
    // Glass, cut-outs and veils.
    ComparedRoom{"curtains", [] { return SolveScene(room_with_curtains(), {.size = 48}); }}};

inline std::string name_of_room(const testing::TestParamInfo<ComparedRoom>& test)
{
    return test.param.name;
}

/// As many rays for all: an error to stop at may be reached a round earlier by one of them.
inline Solved solve_links(const SolveScene& world, const LinksOptions& method, std::uint64_t rays)
{
    return solve_scene(world, {.method = method, .max_shots = rays, .target_error = 0.0});
}

/// Mean of |difference| in terms of the mean.
inline double mean_difference(const std::vector<glm::vec3>& one,
                              const std::vector<glm::vec3>& other)
{
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            difference += std::abs(double(one[i][c]) - double(other[i][c]));
            sum += double(other[i][c]);
        }
    return difference / sum;
}

/// error: how far the stated errors may be apart, in terms of the host's.
inline void expect_agreement(const ComparedRoom& room, const LinksOptions& device,
                             const LinksOptions& host, double error)
{
    constexpr std::uint64_t kRays = 48;
    const SolveScene world = room.prepare();
    const Solved found = solve_links(world, device, kRays);
    const Solved expected = solve_links(world, host, kRays);
    EXPECT_EQ(found.state.shots, expected.state.shots);
    const double difference = mean_difference(found.irradiance, expected.irradiance);
    std::printf("%.5f %% apart\n", 100.0 * difference);
    EXPECT_LE(difference, 0.005);
    EXPECT_NEAR(found.state.error, expected.state.error, error * expected.state.error);
}

}  // namespace lumel::support
