// A bake over several pages has the light of one map, and can be worked on as such.

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "bake/bake.h"
#include "bake/update.h"
#include "images/image_files.h"
#include "prepare/prepare.h"
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
            const int page = scene.materials[std::size_t(primitive.material)].lightmap_page;
            const Image& map = maps.at(std::size_t(page));
            for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
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
    EXPECT_GT(mean_difference(expected, light_at_triangles(bake_into("before", 9), pages)), 0.1);
}

}  // namespace
}  // namespace lumel
