// A bake over several pages has the light of one map, and can be worked on as such.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "../scene/gltf_builder.h"
#include "../support/temporary_folder.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/files.h"
#include "base/images/image_files.h"
#include "jobs/bake/bake.h"
#include "jobs/update/update.h"
#include "solved.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr float kDensity = 100.0f;  // [texels/m]
constexpr int kSide = 96;           // of a page: too small for a wall and the ceiling together

BakeOptions paged(int pages)
{
    BakeOptions options;
    options.atlas = {
        .texels_per_metre = kDensity, .max_size = pages > 1 ? kSide : 1024, .pages = pages};
    options.solver.method = LinksOptions{};
    options.solver.target_error = 0.02;
    options.preview_width = 0;
    return options;
}

/// Irradiance at the middles of triangles, as an engine finds it: by the material's page and
/// TEXCOORD_1, (instance name, primitive, triangle) → [lx].
using LightAt = std::map<std::tuple<std::string, std::size_t, std::size_t>, glm::vec3>;

LightAt light_at_triangles(const std::string& folder, int pages)
{
    std::vector<Image> maps;
    for (int page = 0; page < pages; ++page)
        maps.push_back(read_exr(folder + (pages > 1 ? "/lightmap-" + std::to_string(page) + ".exr"
                                                    : std::string("/lightmap.exr"))));
    const Scene scene = read_scene(folder + "/scene.glb", MaterialModel::diffuse, {});
    LightAt light;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const Primitive& primitive = mesh.primitives[p];
            const auto page_of = [&](std::uint32_t vertex) {
                return primitive.lightmap_pages.empty()
                           ? scene.materials[std::size_t(primitive.material)].lightmap_page
                           : int(primitive.lightmap_pages[vertex]);
            };
            for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
                const Image& map = maps.at(std::size_t(page_of(primitive.indices[t])));
                glm::vec2 place(0.0f);
                for (std::size_t k = t; k < t + 3; ++k)
                    place += primitive.texcoords[1][primitive.indices[k]] / 3.0f;
                const float* texel =
                    map.at(int(place.x * float(map.width)), int(place.y * float(map.height)));
                light[{instance.name, p, t}] = {texel[0], texel[1], texel[2]};
            }
        }
    }
    return light;
}

double mean_difference(const LightAt& a, const LightAt& b)
{
    double sum = 0.0, whole = 0.0;
    for (const auto& [place, light] : a) {
        sum += double(glm::length(light - b.at(place)));
        whole += double(glm::length(light));
    }
    return sum / whole;
}

int pages_in(const std::string& folder)
{
    int pages = 0;
    while (fs::exists(folder + "/lightmap-" + std::to_string(pages) + ".exr"))
        ++pages;
    return pages;
}

class Pages : public ::testing::Test {
protected:
    const test::TemporaryFolder place_;
    const std::string scene_ = support::scene_path("cornell-box");

    std::string bake_into(const std::string& name, int pages)
    {
        bake(scene_, place_ / name, paged(pages));
        return place_ / name;
    }
};

TEST_F(Pages, HaveTheLightOfOneMap)
{
    const std::string one = bake_into("one", 1), many = bake_into("many", 9);
    const int pages = pages_in(many);
    ASSERT_GT(pages, 1);
    EXPECT_FALSE(fs::exists(many + "/lightmap.exr"));
    // Rays start at other places of the lumels: what is left is the error of both.
    EXPECT_LT(mean_difference(light_at_triangles(one, 1), light_at_triangles(many, pages)), 0.03);
}

TEST_F(Pages, AreAsManyAsTheLastBakeHas)
{
    const std::string folder = bake_into("out", 9);
    ASSERT_GT(pages_in(folder), 1);
    bake_into("out", 1);
    EXPECT_EQ(pages_in(folder), 0);
    EXPECT_TRUE(fs::exists(folder + "/lightmap.exr"));
    EXPECT_TRUE(fs::exists(folder + "/lightmap.png"));
    bake_into("out", 9);
    EXPECT_GT(pages_in(folder), 1);
    EXPECT_FALSE(fs::exists(folder + "/lightmap.exr"));
    EXPECT_FALSE(fs::exists(folder + "/lightmap.png"));
}

TEST_F(Pages, AreFoundAgainByAnUpdate)
{
    const std::string folder = bake_into("out", 9);
    const int pages = pages_in(folder);
    const LightAt before = light_at_triangles(folder, pages);
    UpdateOptions edit;
    edit.preview_width = 0;
    edit.lights.sky_color = glm::vec3(5.0f);  // [cd/m²], as bright inside as the lamp makes it
    update(folder, scene_, edit);
    ASSERT_EQ(pages_in(folder), pages);

    BakeOptions anew = paged(9);
    anew.lights = edit.lights;
    bake(scene_, place_ / "anew", anew);
    const LightAt expected = light_at_triangles(place_ / "anew", pages);
    EXPECT_LT(mean_difference(expected, light_at_triangles(folder, pages)), 0.03);
    EXPECT_GT(mean_difference(expected, before), 0.1);
}

constexpr int kMany = 24, kFew = 6;  ///< cubes

/// Cubes on one level, in one primitive: more than a page holds.
std::string cubes_in(const test::TempFolder& place, int cubes = kMany)
{
    constexpr float kEdge = 0.5f, kStep = 0.8f;  // [m]
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    const std::array<std::uint32_t, 36> cube = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6,
                                                0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,
                                                0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    for (int n = 0; n < cubes; ++n) {
        const auto first = std::uint32_t(positions.size());
        for (int corner = 0; corner < 8; ++corner)
            positions.push_back(glm::vec3(kStep * float(n % 6), 0.0f, kStep * float(n / 6)) +
                                kEdge * glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2));
        for (const std::uint32_t index : cube)
            indices.push_back(first + index);
    }
    test::GltfBuilder builder;
    const int place_of = builder.add_positions(positions);
    const int index = builder.add_accessor(indices, "SCALAR", 5125, indices.size());
    builder.show({{"attributes", {{"POSITION", place_of}}}, {"indices", index}});
    return builder.write(place);
}

BakeOptions cubes_on(int pages)
{
    BakeOptions options = paged(pages);
    options.atlas.texels_per_metre = 40.0f;
    options.lights.sky_color = glm::vec3(100.0f);
    return options;
}

/// Irradiance at the middles of triangles by where they are, as an engine finds it that knows
/// nothing of marks: by the page of each primitive's material.
std::map<std::array<long, 3>, glm::vec3> light_at_places(const std::string& folder, int pages)
{
    Bytes file = read_file(folder + "/scene.glb", "");
    const std::string mark = "lumel_part", none = "other_part";
    for (auto found = file.begin();
         (found = std::search(found, file.end(), mark.begin(), mark.end())) != file.end();)
        std::copy(none.begin(), none.end(), found);
    const std::string copy = folder + "/unmarked.glb";
    write_bytes(copy, std::as_bytes(std::span(file)));

    std::map<std::array<long, 3>, glm::vec3> light;
    const Scene scene = read_scene(copy, MaterialModel::diffuse, {});
    for (const Primitive& primitive : scene.meshes.at(0).primitives) {
        EXPECT_TRUE(primitive.lightmap_pages.empty());
        const int page = scene.materials[std::size_t(primitive.material)].lightmap_page;
        const Image map = read_exr(
            folder + (pages > 1 ? "/lightmap-" + std::to_string(page) : std::string("/lightmap")) +
            ".exr");
        for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
            glm::vec2 texel(0.0f);
            glm::vec3 middle(0.0f);
            for (std::size_t k = t; k < t + 3; ++k) {
                texel += primitive.texcoords[1][primitive.indices[k]] / 3.0f;
                middle += primitive.positions[primitive.indices[k]] / 3.0f;
            }
            const float* rgb =
                map.at(int(texel.x * float(map.width)), int(texel.y * float(map.height)));
            light[{std::lround(1e3f * middle.x), std::lround(1e3f * middle.y),
                   std::lround(1e3f * middle.z)}] = {rgb[0], rgb[1], rgb[2]};
        }
    }
    return light;
}

template <class Light>
double mean_difference_of(const Light& a, const Light& b)
{
    EXPECT_EQ(a.size(), b.size());
    double sum = 0.0, whole = 0.0;
    for (const auto& [place, light] : a) {
        sum += double(glm::length(light - b.at(place)));
        whole += double(glm::length(light));
    }
    return sum / whole;
}

TEST(PagesOfOnePrimitive, HaveTheLightOfOneMap)
{
    const test::TempFolder place;
    const std::string scene = cubes_in(place), one = place.path("one"), many = place.path("many");
    bake(scene, one, cubes_on(1));
    bake(scene, many, cubes_on(9));
    const int pages = pages_in(many);
    ASSERT_GT(pages, 2);
    const auto expected = light_at_places(one, 1);
    EXPECT_EQ(expected.size(), std::size_t(kMany) * 12u);
    EXPECT_LT(mean_difference_of(expected, light_at_places(many, pages)), 0.03);
}

TEST(PagesOfOnePrimitive, AreOneAgainWhereTheFileIsRead)
{
    const test::TempFolder place;
    const std::string scene = cubes_in(place), many = place.path("many");
    bake(scene, many, cubes_on(9));
    const Scene given = read_scene(scene, MaterialModel::diffuse, {}),
                baked = read_scene(many + "/scene.glb", MaterialModel::diffuse, {});
    ASSERT_EQ(baked.meshes.at(0).primitives.size(), 1u);
    const Primitive &a = given.meshes.at(0).primitives.at(0),
                    &b = baked.meshes.at(0).primitives.at(0);
    ASSERT_EQ(a.indices.size(), b.indices.size());
    for (std::size_t k = 0; k < a.indices.size(); ++k)
        EXPECT_EQ(a.positions[a.indices[k]], b.positions[b.indices[k]]);
}

TEST(PagesOfOnePrimitive, AreFoundAgainByAnUpdate)
{
    const test::TempFolder place;
    const std::string scene = cubes_in(place, kFew), folder = place.path("out"),
                      anew = place.path("anew");
    BakeOptions options = cubes_on(9);
    options.atlas.texels_per_metre = 20.0f;
    options.atlas.max_size = 32;
    bake(scene, folder, options);
    const int pages = pages_in(folder);
    UpdateOptions edit;
    edit.preview_width = 0;
    edit.lights.sky_color = glm::vec3(50.0f, 100.0f, 200.0f);  // [cd/m²]
    update(folder, scene, edit);
    ASSERT_GT(pages, 2);
    ASSERT_EQ(pages_in(folder), pages);
    options.lights = edit.lights;
    bake(scene, anew, options);
    EXPECT_LT(mean_difference_of(light_at_places(anew, pages), light_at_places(folder, pages)),
              0.03);
}

}  // namespace
}  // namespace lumel
