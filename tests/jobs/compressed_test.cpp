// A scene.glb with compressed geometry shows the light of the plain one.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/input_error.h"
#include "../support/source_folder.h"
#include "../support/temporary_folder.h"
#include "base/core/files.h"
#include "base/images/image_files.h"
#include "jobs/bake/bake.h"
#include "jobs/update/update.h"
#include "solved.h"

namespace lumel {
namespace {

/// Corners of a triangle, and the light at points on it.
struct LitTriangle {
    glm::vec3 centre{0.0f};
    std::vector<glm::vec3> light;  ///< [lx]
};

glm::vec3 texel(const Image& map, int x, int y)
{
    const auto inside = [](int at, int size) { return std::size_t(std::clamp(at, 0, size - 1)); };
    const std::size_t i =
        4 * (inside(y, map.height) * std::size_t(map.width) + inside(x, map.width));
    return {map.values[i], map.values[i + 1], map.values[i + 2]};
}

glm::vec3 bilinear(const Image& map, const glm::vec2& at)
{
    const glm::vec2 place = at * glm::vec2(map.width, map.height) - 0.5f;
    const glm::vec2 corner = glm::floor(place), weight = place - corner;
    const int x = int(corner.x), y = int(corner.y);
    return glm::mix(glm::mix(texel(map, x, y), texel(map, x + 1, y), weight.x),
                    glm::mix(texel(map, x, y + 1), texel(map, x + 1, y + 1), weight.x), weight.y);
}

/// By instance and material.
std::map<std::string, std::vector<LitTriangle>> lit_triangles(const std::string& folder)
{
    // Turned with the triangle, whose first corner may be any.
    constexpr float kNear = 0.8f, kFar = 0.1f;
    const Image map = read_exr(folder + "/lightmap.exr");
    const Scene scene = read_scene(folder + "/scene.glb", MaterialModel::diffuse, {});
    std::map<std::string, std::vector<LitTriangle>> all;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives) {
            std::vector<LitTriangle>& lit =
                all[instance.name + ": " + scene.materials[std::size_t(primitive.material)].name];
            for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
                LitTriangle& triangle = lit.emplace_back();
                std::array<glm::vec2, 3> at;
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t vertex = primitive.indices[i + k];
                    triangle.centre += glm::vec3(instance.transform *
                                                 glm::vec4(primitive.positions[vertex], 1.0f)) /
                                       3.0f;
                    at[k] = primitive.texcoords[1][vertex];
                }
                triangle.light = {bilinear(map, (at[0] + at[1] + at[2]) / 3.0f)};
                for (std::size_t k = 0; k < 3; ++k)
                    triangle.light.push_back(bilinear(map, kNear * at[k] + kFar * at[(k + 1) % 3] +
                                                               kFar * at[(k + 2) % 3]));
            }
        }
    return all;
}

/// Largest difference of light at a turn of the corners [lx].
float difference(const LitTriangle& a, const LitTriangle& b, std::size_t turn)
{
    float most = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 d = glm::abs(a.light[1 + k] - b.light[1 + (k + turn) % 3]);
        most = std::max({most, d.r, d.g, d.b});
    }
    return most;
}

BakeOptions quick_bake(int size)
{
    BakeOptions options;
    options.atlas.size = size;
    options.solver.method = LinksOptions{.rays = Rays::host};
    options.solver.max_shots = 12;
    options.solver.target_error = 0.0;
    options.preview_width = 0;
    return options;
}

TEST(CompressedScene, HasTheLightOfThePlainOneAtEveryPoint)
{
    const test::TemporaryFolder folder;
    BakeOptions options = quick_bake(128);
    const std::string scene = support::source_path("scenes/room.gltf");
    bake(scene, folder / "plain", options);
    options.compression = Compression::draco;
    bake(scene, folder / "packed", options);
    ASSERT_EQ(read_exr(folder / "packed/lightmap.exr").values,
              read_exr(folder / "plain/lightmap.exr").values);
    EXPECT_LT(read_file(folder / "packed/scene.glb", "packed").size(),
              read_file(folder / "plain/scene.glb", "plain").size());

    const auto plain = lit_triangles(folder / "plain"), packed = lit_triangles(folder / "packed");
    ASSERT_EQ(plain.size(), packed.size());
    std::size_t compared = 0;
    for (const auto& [name, triangles] : plain) {
        SCOPED_TRACE(name);
        ASSERT_TRUE(packed.contains(name));
        const std::vector<LitTriangle>& others = packed.at(name);
        ASSERT_EQ(triangles.size(), others.size());
        for (const LitTriangle& one : triangles) {
            const auto found = std::ranges::min_element(others, {}, [&](const LitTriangle& other) {
                return glm::distance(one.centre, other.centre);
            });
            EXPECT_LT(glm::distance(one.centre, found->centre), 1e-4f);
            const glm::vec3& light = one.light[0];
            const float bright = std::max({light.r, light.g, light.b});
            const float least = std::min({difference(one, *found, 0), difference(one, *found, 1),
                                          difference(one, *found, 2)});
            EXPECT_LE(least, 1e-3f * bright + 1e-3f);
            ++compared;
        }
    }
    EXPECT_GT(compared, 1000u);
}

TEST(CompressedScene, ThatIsRoundedIsRefusedWhereTrianglesMustBeExact)
{
    const test::TemporaryFolder folder;
    BakeOptions options = quick_bake(32);
    options.compression = Compression::draco;
    const std::string scene = support::source_path("scenes/cornell-box.gltf");
    bake(scene, folder / "out", options);
    EXPECT_NE(
        test::input_error_of([&] { update(folder / "out", scene, {}); }).find("--compress draco"),
        std::string::npos);
    options.keep_links = true;
    EXPECT_NE(test::input_error_of([&] {
                  bake(scene, folder / "kept", options);
              }).find("--compress draco"),
              std::string::npos);
}

}  // namespace
}  // namespace lumel
