#pragma once
// A closed room of one albedo whose walls emit 1 lm/m².

#include "../support/box_lumels.h"
#include "solved.h"

namespace lumel::support {

/// Mean irradiance of its lumels [lx].
inline double mean_in_closed_room(float albedo, const SolverOptions& options)
{
    Quad look{.albedo = glm::vec3(albedo), .emission = glm::vec3(1.0f)};
    look.res_u = look.res_v = 16;
    const auto walls = box_walls({0, 0, 0}, {2.0f, 1.5f, 3.0f}, true, look);
    const std::vector<Quad> quads(walls.begin(), walls.end());
    HandMade room = make_quads(quads);
    room.scene.max_albedo = 1.0f;
    const Atlas atlas = lay_out(room, quads);
    const Solved solved = solve_scene(SolveScene(room.scene, atlas, room.lumels), options);
    double light = 0.0, area = 0.0;
    for (std::size_t i = 0; i < solved.irradiance.size(); ++i) {
        light += double(room.lumels.lumels[i].area) * double(solved.irradiance[i].g);
        area += double(room.lumels.lumels[i].area);
    }
    return light / area;
}

}  // namespace lumel::support
