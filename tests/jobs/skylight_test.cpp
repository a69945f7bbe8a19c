// A black room under a hole in its roof: all light is the sky's, found by few of the rays. Its
// illuminance on the floor is an integral over the hole.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "../support/lamps.h"
#include "solved.h"

namespace lumel {
namespace {

constexpr float kWide = 6.0f, kHigh = 3.0f, kDeep = 4.0f, kHole = 1.0f;  // [m]
constexpr float kSky = 1000.0f;                                          // [cd/m²]

void add_black(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v)
{
    support::add_quad(scene,
                      {.corner = corner, .edge_u = u, .edge_v = v, .albedo = glm::vec3(0.0f)});
}

Scene skylit_room()
{
    Scene scene;
    scene.sky = support::even_sky(glm::vec3(kSky));
    const auto add = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        add_black(scene, corner, u, v);
    };
    const glm::vec3 x(kWide, 0.0f, 0.0f), y(0.0f, kHigh, 0.0f), z(0.0f, 0.0f, kDeep), none(0.0f);
    add(none, z, x);
    add(none, x, y);
    add(z, y, x);
    add(none, y, z);
    add(x, z, y);
    // Four parts of the ceiling around the hole.
    const float from_x = 0.5f * (kWide - kHole), to_x = from_x + kHole,
                from_z = 0.5f * (kDeep - kHole), to_z = from_z + kHole;
    const auto add_ceiling = [&](float x0, float x1, float z0, float z1) {
        add({x0, kHigh, z0}, {x1 - x0, 0.0f, 0.0f}, {0.0f, 0.0f, z1 - z0});
    };
    add_ceiling(0.0f, from_x, 0.0f, kDeep);
    add_ceiling(to_x, kWide, 0.0f, kDeep);
    add_ceiling(from_x, to_x, 0.0f, from_z);
    add_ceiling(from_x, to_x, to_z, kDeep);
    return scene;
}

/// L ∫ cos² / r² dA over the hole, by midpoints [lx].
double exact(const glm::vec3& point)
{
    constexpr int kSteps = 32;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double dx = 0.5 * kWide + kHole * ((i + 0.5) / kSteps - 0.5) - double(point.x),
                         dz = 0.5 * kDeep + kHole * ((j + 0.5) / kSteps - 0.5) - double(point.z),
                         square = dx * dx + dz * dz + kHigh * kHigh;
            sum += kHigh * kHigh / (square * square);
        }
    return double(kSky) * sum * kHole * kHole / (kSteps * kSteps);
}

/// To what an eye sees, with at most so many rays per lumel.
support::Solved solved_by(const SolveScene& world, std::uint64_t rays)
{
    SolverOptions options;
    options.method = support::method("links");
    options.target_error = 0.0;
    options.target_quality = kGood;
    options.max_shots = rays;
    return support::solve_scene(world, options);
}

/// The noise that an eye sees is judged away from the walls, but it comes from lumels beside them
/// as well: the filter mixes these in. Without rays for these the foot of the walls stays full of
/// specks, however many rays the floor gets.
TEST(Skylight, IsCleanUpToTheFootOfTheWalls)
{
    const SolveScene world(skylit_room(), {.texels_per_metre = 10.0f});
    const support::Solved solved = solved_by(world, 600);
    double squares = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < world.lumels.lumels.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        const glm::vec3& at = lumel.position;
        const float to_wall = std::min({at.x, at.z, kWide - at.x, kDeep - at.z});
        if (lumel.normal.y < 0.5f || to_wall > 3.0f * lumel.size)
            continue;
        const double off = double(solved.irradiance[i].g) / exact(at) - 1.0;
        squares += off * off;
        ++count;
    }
    EXPECT_GT(count, 500);
    EXPECT_LT(std::sqrt(squares / count), 0.05);
}

/// A kerb across the floor, at an angle to the texels. Its side `n` faces the hole.
struct Kerb {
    static constexpr float kHeight = 0.2f, kLength = 2.5f, kThickness = 0.3f;  // [m]

    glm::vec3 corner{0.8f, 0.0f, 0.8f};
    glm::vec3 along = glm::normalize(glm::vec3(0.3f, 0.0f, 1.0f));
    glm::vec3 n = glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), along);

    void add_to(Scene& scene) const
    {
        const glm::vec3 u = kLength * along, v = -kThickness * n, up(0.0f, kHeight, 0.0f);
        add_black(scene, corner, up, u);
        add_black(scene, corner + v, u, up);
        add_black(scene, corner, v, up);
        add_black(scene, corner + u, up, v);
        add_black(scene, corner + up, v, u);
    }
};

/// Lumels that the kerb covers in part have their light from as few rays as others, and are
/// filtered like these.
TEST(Skylight, IsCleanWhereAKerbCoversPartsOfLumels)
{
    constexpr float kTexels = 10.0f;  // per metre
    Scene scene = skylit_room();
    const Kerb kerb;
    kerb.add_to(scene);
    const SolveScene world(std::move(scene), {.texels_per_metre = kTexels});
    const support::Solved solved = solved_by(world, 200);
    double squares = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < world.lumels.lumels.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        const glm::vec3 from = lumel.position - kerb.corner;
        const float aside = glm::dot(from, kerb.n), along = glm::dot(from, kerb.along);
        const bool is_covered = lumel.area < 0.95f / (kTexels * kTexels);
        if (lumel.normal.y < 0.5f || lumel.position.y > 0.0f || (lumel.flags & kLumelBuried) ||
            !is_covered || std::abs(aside) > 1.0f / kTexels || along < 0.1f ||
            along > Kerb::kLength - 0.1f)
            continue;
        const double off = double(solved.irradiance[i].g) / exact(lumel.position) - 1.0;
        squares += off * off;
        ++count;
    }
    EXPECT_GT(count, 20);
    EXPECT_LT(std::sqrt(squares / count), 0.17);
}

}  // namespace
}  // namespace lumel
