// What bake and info say about a scene: only what helps.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "../support/box_lumels.h"
#include "../support/source_folder.h"
#include "jobs/bake/advice.h"

namespace lumel {
namespace {

using Sentences = std::vector<std::string>;

void add(Scene& scene, const std::string& name, float side, const glm::vec3& corner,
         bool double_sided = false)
{
    support::add_quad(scene, {.corner = corner,
                              .edge_u = {0.0f, 0.0f, side},
                              .edge_v = {side, 0.0f, 0.0f},
                              .double_sided = double_sided});
    scene.instances.back().name = name;
}

/// A ground with three tables.
Scene tables(float ground, bool double_sided = false)
{
    Scene scene;
    add(scene, "ground", ground, glm::vec3(0.0f));
    for (int t = 0; t < 3; ++t)
        add(scene, "table", 2.0f, {3.0f * float(t), 1.0f, 0.0f}, double_sided);
    return scene;
}

Sentences advice_on(const Scene& scene)
{
    const AtlasOptions options{.size = 128};
    return advice(SolveScene(scene, options), options);
}

/// Expects one sentence with these words.
void expect_one(const Sentences& sentences, const Sentences& words)
{
    ASSERT_EQ(sentences.size(), 1u);
    for (const std::string& word : words)
        EXPECT_NE(sentences[0].find(word), std::string::npos) << word << ": " << sentences[0];
}

TEST(Advice, IsSilentOnUsualScenes)
{
    for (const char* name : {"scenes/cornell-box.gltf", "scenes/room.gltf", "scenes/city.gltf"})
        EXPECT_EQ(advice_on(read_gltf(support::source_path(name))), Sentences()) << name;
    EXPECT_EQ(advice_on(tables(3.0f)), Sentences());
}

TEST(Advice, SaysWhereItIsNoisy)
{
    Scene scene = tables(3.0f);
    expect_one({where_it_is_noisy(scene, {{1, 0.022}, {0, 0.0113}})},
               {"\"table\" (2.2 %), \"ground\" (1.1 %)"});
    expect_one({where_it_is_noisy(scene, {{0, 0.04}, {1, 0.03}, {2, 0.02}, {3, 0.01}})},
               {"(4.0 %)", "(2.0 %) and 1 more"});
    for (Instance& instance : scene.instances)
        instance.name.clear();
    EXPECT_EQ(where_it_is_noisy(scene, {{0, 0.04}}), "");
    EXPECT_EQ(where_it_is_noisy(scene, {}), "");
}

TEST(Advice, NamesAGroundThatTakesTheLumels)
{
    const Scene scene = tables(10.0f);
    expect_one(advice_on(scene), {"\"ground\"", "--density"});
    const AtlasOptions chosen{.size = 128, .coarse_afar = true};
    EXPECT_EQ(advice(SolveScene(scene, chosen), chosen), Sentences());
}

TEST(Advice, LeavesARoomAloneWhoseObjectsFillIt)
{
    Scene scene = tables(10.0f);
    add(scene, "table", 2.0f, {7.0f, 1.0f, 7.0f});
    EXPECT_EQ(advice_on(scene), Sentences());
}

TEST(Advice, TellsOfBackSides)
{
    const AtlasOptions options{.size = 64, .sides = Sides::both};
    expect_one(advice(SolveScene(tables(1.0f, true), options), options),
               {"back sides", "single-sided"});
}

/// A plate before a lamp and a camera, which look along -z.
Scene plate_before_them(bool turned, bool double_sided)
{
    Scene scene;
    support::Quad plate{.corner = {-9.0f, -9.0f, -1.0f},
                        .edge_u = {18.0f, 0.0f, 0.0f},
                        .edge_v = {0.0f, 18.0f, 0.0f},
                        .double_sided = double_sided};
    if (turned)
        std::swap(plate.edge_u, plate.edge_v);
    support::add_quad(scene, plate);
    scene.instances.back().name = "plate";
    return scene;
}

TEST(Advice, NamesWhatLampsAndCamerasSeeFromBehind)
{
    for (const bool turned : {false, true})
        for (const bool double_sided : {false, true})
            for (const bool has_lamp : {false, true}) {
                Scene scene = plate_before_them(turned, double_sided);
                if (has_lamp)
                    scene.lights = {{.kind = PunctualLight::Kind::point}};
                else
                    scene.cameras.push_back({});
                if (turned && !double_sided)
                    expect_one(advice_on(scene), {"100 % of", "\"plate\" from behind",
                                                  has_lamp ? "lamps" : "camera"});
                else
                    for (const std::string& sentence : advice_on(scene))
                        EXPECT_EQ(sentence.find("from behind"), std::string::npos) << sentence;
            }
}

TEST(Advice, TellsOfLumelsWithoutLight)
{
    const AtlasOptions options{.size = 128};
    const SolveScene scene(tables(3.0f), options);
    const auto& lumels = scene.lumels.lumels;
    std::vector<glm::vec3> light(lumels.size(), glm::vec3(1.0f));
    EXPECT_EQ(of_dark_lumels(scene, options, light), "");
    std::size_t dark = 0;
    for (std::size_t i = 0; i < lumels.size(); ++i)
        if (lumels[i].instance == 0) {
            light[i] = glm::vec3(0.0f);
            ++dark;
        }
    const double share = double(dark) / double(lumels.size());
    ASSERT_GT(share, 0.34);
    ASSERT_LT(share, 0.66);
    expect_one({of_dark_lumels(scene, options, light)},
               {fmt::format("{:.0f} % of the lumels get no light", 100.0 * share),
                "100 % of them on \"ground\"",
                fmt::format("{:.1f} times the texels", 1.0 / std::sqrt(1.0 - share))});
    const AtlasOptions chosen{.texels_per_metre = 4.0f};
    expect_one({of_dark_lumels(scene, chosen, light)}, {"less time and memory"});
    // Other warnings tell of a map that is black everywhere.
    EXPECT_EQ(of_dark_lumels(scene, options, std::vector<glm::vec3>(lumels.size())), "");
}

TEST(Advice, TellsOfASkyThatIsDarkBesideTheSun)
{
    PunctualLight sun{.kind = PunctualLight::Kind::directional, .intensity = 1e5f};
    sun.transform = glm::rotate(glm::mat4(1.0f), -1.2f, glm::vec3(1.0f, 0.0f, 0.0f));
    Scene scene = tables(3.0f);
    scene.lights.push_back(sun);
    expect_one(advice_on(scene), {"0 lx", "--sky"});
    add_lights(scene, {.sky_color = glm::vec3(1.0f)});
    expect_one(advice_on(scene), {"3.1 lx", "--sky-scale"});
    scene.sky = {};
    add_lights(scene, {.sky_color = glm::vec3(3e3f)});
    EXPECT_EQ(advice_on(scene), Sentences());
}

}  // namespace
}  // namespace lumel
