#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "atlas/finish/finish.h"
#include "atlas/finish/seam_edges.h"
#include "grid_lumels.h"

namespace lumel {
namespace {

constexpr int kSide = 64;  // of the atlas [texels]

// A flat quad of the world and its rectangle in the atlas. Points: corner + s across + t up.
struct Patch {
    glm::vec3 corner, across, up;
    glm::vec3 normal_left, normal_right;  // shading normals at s = 0 and s = 1
    glm::vec2 place, size;                // [texels]
};

struct World {
    Scene scene;
    Atlas atlas;
    Lumels lumels;
};

void add(World& world, const Patch& patch, const glm::mat4& transform = glm::mat4(1.0f))
{
    Primitive primitive;
    Surface surface;
    for (const glm::vec2& st :
         {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        primitive.positions.push_back(patch.corner + st.x * patch.across + st.y * patch.up);
        primitive.normals.push_back(st.x == 0.0f ? patch.normal_left : patch.normal_right);
        surface.source_vertex.push_back(std::uint32_t(surface.source_vertex.size()));
        surface.texcoord.push_back(patch.place + st * patch.size);
    }
    primitive.indices = surface.indices = {0, 1, 2, 0, 2, 3};
    surface.instance = std::uint32_t(world.scene.instances.size());
    surface.chart = {surface.instance, surface.instance};
    Mesh mesh;
    mesh.primitives.push_back(primitive);
    Instance instance;
    instance.mesh = int(world.scene.meshes.size());
    instance.transform = transform;
    world.scene.meshes.push_back(mesh);
    world.scene.instances.push_back(instance);
    world.atlas.surfaces.push_back(surface);
}

World world_of(const std::vector<Patch>& patches)
{
    World world;
    for (const Patch& patch : patches)
        add(world, patch);
    return world;
}

// Length of [from, to] inside the texel that starts at `texel`.
float overlap(float from, float to, int texel)
{
    return std::max(0.0f, std::min(to, float(texel + 1)) - std::max(from, float(texel)));
}

// Every covered texel gets light(patch number, s, t) at its covered part's centre.
Image lit_map(World& world, const std::vector<Patch>& patches,
              const std::function<float(std::size_t, float, float)>& light)
{
    world.atlas.width = world.atlas.height = world.lumels.width = world.lumels.height = kSide;
    world.lumels.coverage.assign(kSide * kSide, 0.0f);
    Image map(kSide, kSide, 4);
    for (std::size_t p = 0; p < patches.size(); ++p) {
        const glm::vec2 low = patches[p].place, high = low + patches[p].size;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const float covered = overlap(low.x, high.x, x) * overlap(low.y, high.y, y);
                if (covered <= 0.0f)
                    continue;
                const glm::vec2 centre = 0.5f * (glm::max(low, glm::vec2(x, y)) +
                                                 glm::min(high, glm::vec2(x + 1, y + 1)));
                const glm::vec2 st = (centre - low) / patches[p].size;
                float* texel = map.at(x, y);
                texel[0] = texel[1] = texel[2] = light(p, st.x, st.y);
                texel[3] = covered;
                world.lumels.coverage[std::size_t(y * kSide + x)] = covered;
            }
    }
    dilate(map);
    return map;
}

float sample(const Image& map, const glm::vec2& place)
{
    const float x = place.x - 0.5f, y = place.y - 0.5f;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const float u = x - float(x0), v = y - float(y0);
    return (1 - v) * ((1 - u) * map.at(x0, y0)[0] + u * map.at(x0 + 1, y0)[0]) +
           v * ((1 - u) * map.at(x0, y0 + 1)[0] + u * map.at(x0 + 1, y0 + 1)[0]);
}

// Largest relative difference along the right side of `a` and the left side of `b`.
float gap(const Image& map, const Patch& a, const Patch& b)
{
    float largest = 0.0f;
    for (float t = 0.0f; t <= 1.0f; t += 1.0f / 256.0f) {
        const float left = sample(map, a.place + glm::vec2(1, t) * a.size);
        const float right = sample(map, b.place + glm::vec2(0, t) * b.size);
        largest = std::max(largest, std::abs(left - right) / std::max(left, right));
    }
    return largest;
}

glm::vec3 at_angle(float degrees)
{
    const float angle = glm::radians(degrees);
    return {std::sin(angle), 0.0f, std::cos(angle)};
}

// Two facets of a cylinder of radius 1 whose shading normals agree at the shared edge, placed off
// the texel grid and with different densities.
std::vector<Patch> cylinder()
{
    const glm::vec3 a = at_angle(0), b = at_angle(20), c = at_angle(40), up = {0, 1, 0};
    return {{a, b - a, up, a, b, {3.3f, 4.7f}, {20.4f, 24.9f}},
            {b, c - b, up, b, c, {30.6f, 7.2f}, {17.1f, 21.3f}}};
}

// Smooth light with the scatter that a solver leaves.
float scattered_light(std::size_t patch, float s, float t)
{
    const float scatter = std::sin(37.0f * t + float(patch) * 2.0f) * std::cos(51.0f * s);
    return 10.0f + 3.0f * (float(patch) + s) + 2.0f * t + 0.8f * scatter;
}

TEST(MatchSeams, ASmoothStripInTwoChartsSamplesAlike)
{
    const std::vector<Patch> patches = cylinder();
    World world = world_of(patches);
    Image map = lit_map(world, patches, scattered_light);
    const float before = gap(map, patches[0], patches[1]);
    match_seams(map, world.scene, world.atlas, world.lumels);
    EXPECT_GT(before, 0.05f);
    EXPECT_LT(gap(map, patches[0], patches[1]), 0.005f);
}

TEST(MatchSeams, OnlyTexelsAtTheSeamChangeAndByLessThanTheGap)
{
    const std::vector<Patch> patches = cylinder();
    World world = world_of(patches);
    const Image before = lit_map(world, patches, scattered_light);
    Image map = before;
    match_seams(map, world.scene, world.atlas, world.lumels);
    const float largest_gap = gap(before, patches[0], patches[1]) * 20.0f;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const float change = std::abs(map.at(x, y)[0] - before.at(x, y)[0]);
            EXPECT_EQ(map.at(x, y)[3], before.at(x, y)[3]);
            if (before.at(x, y)[3] > 0.5f) {
                EXPECT_LT(change, largest_gap);
            }
            const bool at_seam = (x >= 22 && x <= 24) || (x >= 29 && x <= 31);
            if (!at_seam) {
                EXPECT_EQ(change, 0.0f);
            }
        }
}

TEST(MatchSeams, ARoomCornerKeepsItsContrast)
{
    const glm::vec3 up(0, 1, 0), x(1, 0, 0), z(0, 0, 1);
    const std::vector<Patch> patches = {{{0, 0, 0}, x, up, z, z, {4, 4}, {16, 16}},
                                        {{1, 0, 0}, z, up, -x, -x, {30, 4}, {16, 16}}};
    World world = world_of(patches);
    const Image before = lit_map(
        world, patches, [](std::size_t patch, float, float) { return patch == 0 ? 10.0f : 8.0f; });
    Image map = before;
    match_seams(map, world.scene, world.atlas, world.lumels);
    EXPECT_EQ(map.values, before.values);
}

TEST(MatchSeams, LightDoesNotLeakPastAWallThatStandsOnTheSeam)
{
    const glm::vec3 up(0, 1, 0), x(1, 0, 0), z(0, 0, 1);
    const std::vector<Patch> patches = {{{0, 0, 0}, x, up, z, z, {4, 4}, {16, 16}},
                                        {{1, 0, 0}, x, up, z, z, {30, 4}, {16, 16}}};
    World world = world_of(patches);
    Image map = lit_map(world, patches,
                        [](std::size_t patch, float, float) { return patch == 0 ? 10.0f : 0.0f; });
    match_seams(map, world.scene, world.atlas, world.lumels);
    EXPECT_EQ(sample(map, patches[1].place + glm::vec2(0, 0.5f) * patches[1].size), 0.0f);
}

TEST(MatchSeams, NeighbouringInstancesMatchAlsoWhenOneIsMirrored)
{
    const glm::vec3 up(0, 1, 0), x(1, 0, 0), z(0, 0, 1);
    // Both show a quad from 0 to 1; the second one mirrors it to 2 … 1, so its right side meets.
    const Patch quad = {{0, 0, 0}, x, up, z, z, {4, 4}, {16, 16}};
    Patch mirrored = quad;
    mirrored.place = {30, 4};
    glm::mat4 mirror(1.0f);
    mirror[0][0] = -1.0f;
    mirror[3][0] = 2.0f;
    World world;
    add(world, quad);
    add(world, mirrored, mirror);
    Image map = lit_map(world, {quad, mirrored}, [](std::size_t patch, float, float t) {
        return 5.0f + t + 0.5f * float(patch);
    });
    match_seams(map, world.scene, world.atlas, world.lumels);
    for (float t = 0.05f; t < 1.0f; t += 0.1f)
        EXPECT_NEAR(sample(map, quad.place + glm::vec2(1, t) * quad.size),
                    sample(map, mirrored.place + glm::vec2(1, t) * mirrored.size), 0.02f);
}

TEST(MatchSeams, TheSameMapGivesTheSameBytes)
{
    const std::vector<Patch> patches = cylinder();
    World world = world_of(patches);
    Image first = lit_map(world, patches, scattered_light);
    Image second = first;
    match_seams(first, world.scene, world.atlas, world.lumels);
    match_seams(second, world.scene, world.atlas, world.lumels);
    EXPECT_EQ(first.values, second.values);
}

TEST(FindSeams, EdgesInsideAChartAreNotSeams)
{
    World world;
    add(world, cylinder()[0]);
    EXPECT_TRUE(find_seams(world.scene, world.atlas).empty());
}

// A wall of 1 m, and beside it one of 2 m whose edge goes on above and below.
TEST(MatchSeams, ObjectsMatchWhereTheirEdgesOverlap)
{
    const glm::vec3 up(0, 1, 0), x(1, 0, 0), z(0, 0, 1);
    const std::vector<Patch> patches = {{{0, 0, 0}, x, up, z, z, {4, 4}, {16, 16}},
                                        {{1, -0.5f, 0}, x, 2.0f * up, z, z, {30, 4}, {16, 32}}};
    World world = world_of(patches);
    const auto light = [](std::size_t patch, float, float) { return patch == 0 ? 10.0f : 8.0f; };
    const Image before = lit_map(world, patches, light);
    Image map = before;
    match_seams(map, world.scene, world.atlas, world.lumels);
    const auto at_edge = [&](float height) {
        const float left = sample(map, patches[0].place + glm::vec2(1, height) * patches[0].size);
        const float right =
            sample(map, patches[1].place + glm::vec2(0, 0.25f + 0.5f * height) * patches[1].size);
        return std::abs(left - right);
    };
    for (float height = 0.05f; height < 1.0f; height += 0.1f)
        EXPECT_LT(at_edge(height), 0.02f) << height;
    // Where the taller one goes on alone nothing changes.
    for (const float part : {0.1f, 0.9f})
        EXPECT_EQ(sample(map, patches[1].place + glm::vec2(0, part) * patches[1].size), 8.0f);
    EXPECT_NEAR(seam_gaps(before, before, world.scene, world.atlas).gap, 0.2, 0.001);
    const SeamGaps after = seam_gaps(map, before, world.scene, world.atlas);
    EXPECT_LT(after.gap, 0.002);
    EXPECT_NEAR(after.length, 16.0, 0.1);
    EXPECT_EQ(after.jumping, 0.0);
}

TEST(FindSeams, BacksOfAThinSheetAreNotJoinedToItsFront)
{
    const glm::vec3 up(0, 1, 0), x(1, 0, 0), z(0, 0, 1);
    World world;
    add(world, {{0, 0, 0}, x, up, z, z, {4, 4}, {16, 16}});
    add(world, {{1, 0, 0}, -x, up, -z, -z, {30, 4}, {16, 16}});
    EXPECT_TRUE(find_seams(world.scene, world.atlas).empty());
}

}  // namespace
}  // namespace lumel
