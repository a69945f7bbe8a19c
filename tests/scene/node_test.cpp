// The node hierarchy: instances, lights and cameras in the world.

#include <gtest/gtest.h>

#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace {

glm::vec3 world_origin(const Instance& instance)
{
    return glm::vec3(instance.transform[3]);
}

}  // namespace

TEST(Nodes, TransformsMultiplyDownTheHierarchy)
{
    GltfBuilder builder = one_triangle();
    builder.json["nodes"][0]["translation"] = {1, 0, 0};
    builder.push(
        "nodes",
        {{"children", {0}}, {"scale", {2, 2, 2}}, {"rotation", {0, 0, 0.70710678, 0.70710678}}});
    builder.json["scenes"][0]["nodes"] = {1};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_NEAR(glm::distance(world_origin(scene.instances[0]), glm::vec3(0, 2, 0)), 0.0f, 1e-6f);
    EXPECT_EQ(scene.instances[0].node, 0);
}

TEST(Nodes, HierarchiesOfTwoThousandLevelsAreRead)
{
    GltfBuilder builder = one_triangle();
    for (int depth = 0; depth < 2000; ++depth)
        builder.push("nodes", {{"children", {depth}}, {"translation", {0, 0, 1}}});
    builder.json["scenes"][0]["nodes"] = {2000};
    const Scene scene = builder.read();
    EXPECT_EQ(glm::dvec3(world_origin(scene.instances.at(0))) + scene.origin,
              glm::dvec3(0, 0, 2000));
}

TEST(Nodes, OneMeshUnderTwoNodesIsReadOnceAndPlacedTwice)
{
    GltfBuilder builder = one_triangle();
    builder.push("nodes", {{"mesh", 0}, {"scale", {-1, 1, 1}}});
    builder.json["scenes"][0]["nodes"] = {1, 0};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.instances[0].node, 0);
    EXPECT_LT(glm::determinant(scene.instances[1].transform), 0.0f);
}

TEST(Nodes, TheDefaultSceneIsChosenAsTheFormatSays)
{
    GltfBuilder builder = one_triangle();
    builder.push("nodes", {{"mesh", 0}, {"name", "second"}});
    builder.push("scenes", {{"nodes", {1}}});
    EXPECT_EQ(builder.read().instances.at(0).node, 0);
    builder.json["scene"] = 1;
    EXPECT_EQ(builder.read().instances.at(0).name, "second");
    builder.json.erase("scene");
    builder.json.erase("scenes");
    EXPECT_EQ(builder.read().instances.size(), 2u);
}

TEST(Nodes, MeshesThatAreNotShownAreNotRead)
{
    GltfBuilder builder = one_triangle();
    builder.push("meshes", {{"primitives", Json::array({{{"attributes", {{"POSITION", 99}}}}})}});
    EXPECT_EQ(builder.read().instances.size(), 1u);
}

TEST(Nodes, BrokenHierarchiesAreErrors)
{
    GltfBuilder cyclic = one_triangle();
    cyclic.json["nodes"][0]["children"] = {0};
    EXPECT_TRUE(contains(error_of(cyclic), "/nodes/0: is its own ancestor"));

    GltfBuilder shared = one_triangle();
    shared.push("nodes", {{"children", {0}}});
    shared.push("nodes", {{"children", {0}}});
    EXPECT_TRUE(contains(error_of(shared), "/nodes/2/children/0: node 0 already is a child"));

    GltfBuilder inner = one_triangle();
    inner.push("nodes", {{"children", {0}}});
    EXPECT_TRUE(contains(error_of(inner), "/scenes/0/nodes/0: node 0 is not a root"));

    GltfBuilder dangling = one_triangle();
    dangling.json["nodes"][0]["children"] = {5};
    EXPECT_TRUE(contains(error_of(dangling), "refers to nodes[5]"));
}

TEST(Nodes, TransformsThatMakeNoSenseAreErrors)
{
    const auto error_with = [](const char* key, const Json& value) {
        GltfBuilder builder = one_triangle();
        builder.json["nodes"][0][key] = value;
        return error_of(builder);
    };
    EXPECT_TRUE(contains(error_with("rotation", {0, 0, 0, 0}), "unit quaternion"));
    EXPECT_TRUE(contains(error_with("translation", {1, 2}), "must hold 3 numbers"));
    EXPECT_TRUE(contains(error_with("translation", {1e300, 0, 0}), "too large"));
    EXPECT_TRUE(contains(error_with("translation", {1e20, 0, 0}), "too far out"));
    EXPECT_TRUE(contains(error_with("scale", {"a", 0, 0}), "/nodes/0/scale/0: must be a number"));
    EXPECT_TRUE(contains(error_with("matrix", Json(std::vector<int>(16, 1))), "not affine"));
}

TEST(Nodes, FlattenedNodesAreLeftOutWithAWarning)
{
    GltfBuilder builder = one_triangle();
    builder.push("nodes", {{"mesh", 0}, {"scale", {0, 0, 0}}});
    builder.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = builder.read();
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(warns(scene, "scale of 0"));
}

TEST(Nodes, TinyScalesAreNotFlat)
{
    GltfBuilder builder = one_triangle();
    builder.json["nodes"][0]["scale"] = {1e-9, 1e-9, 1e-9};
    EXPECT_EQ(builder.read().instances.size(), 1u);
}

TEST(Nodes, SkinsAreIgnoredWithAWarning)
{
    GltfBuilder builder = one_triangle();
    builder.push("skins", {{"joints", {0}}});
    builder.json["nodes"][0]["skin"] = 0;
    EXPECT_TRUE(warns(builder.read(), "skeleton"));
}

TEST(Nodes, PunctualLightsAreStoredWithAWarning)
{
    GltfBuilder builder = one_triangle();
    builder.json["extensionsRequired"] = {"KHR_lights_punctual"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "spot"},
                      {"intensity", 100},
                      {"color", {1, 0.5, 0}},
                      {"range", 5},
                      {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}});
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    builder.json["nodes"][0]["translation"] = {0, 3, 0};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.lights.size(), 1u);
    const PunctualLight& light = scene.lights[0];
    EXPECT_EQ(light.kind, PunctualLight::Kind::spot);
    EXPECT_EQ(light.color, glm::vec3(1, 0.5f, 0));
    EXPECT_FLOAT_EQ(light.intensity, 100);
    EXPECT_FLOAT_EQ(light.range, 5);
    EXPECT_FLOAT_EQ(light.outer_cone, 0.2f);
    EXPECT_EQ(glm::vec3(light.transform[3]), glm::vec3(0, 3, 0));
}

TEST(Nodes, ScaleDoesNotCountForLightsButMirrorsDo)
{
    GltfBuilder builder = one_triangle();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"][0] = {{"type", "point"}};
    builder.json["nodes"][0] = {{"mesh", 0},
                                {"scale", {2, -3, 5}},
                                {"rotation", {0, 0.70710678, 0, 0.70710678}},
                                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    const glm::mat3 frame(builder.read().lights.at(0).transform);
    EXPECT_LT(glm::distance(frame[0], glm::vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(glm::distance(frame[1], glm::vec3(0, -1, 0)), 1e-6f);
    EXPECT_LT(glm::distance(frame[2], glm::vec3(1, 0, 0)), 1e-6f);
}

TEST(Nodes, ExtrasGiveLightsTheirSizeAndTheNodeHasTheLastWord)
{
    GltfBuilder builder = one_triangle();
    Json& light = builder.json["extensions"]["KHR_lights_punctual"]["lights"][0];
    light = {{"type", "point"}, {"extras", {{"radius", 0.25}, {"angle", 1}}}};
    Json& node = builder.json["nodes"][0];
    node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    EXPECT_FLOAT_EQ(builder.read().lights.at(0).radius, 0.25f);
    EXPECT_EQ(builder.read().lights.at(0).angle, 0.0f);
    node["extras"] = {{"radius", 0.5}};
    EXPECT_FLOAT_EQ(builder.read().lights.at(0).radius, 0.5f);
    light["type"] = "directional";
    node["extras"] = "anything";
    EXPECT_FLOAT_EQ(builder.read().lights.at(0).angle, 0.785398f);  // 1 rad is more than can be
    light["extras"] = {{"angle", -1}};
    EXPECT_TRUE(contains(error_of(builder), "/extras/angle: is a size"));
}

TEST(Nodes, PhotometricLightsShineAsTheirFileSays)
{
    const std::string ies = "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n0 90 0 30 30\n";
    GltfBuilder builder = one_triangle();
    const int view = builder.add_view(ies.data(), ies.size());
    builder.json["extensionsRequired"] = {"EXT_lights_ies"};
    builder.json["extensions"]["EXT_lights_ies"]["lights"] =
        Json::array({{{"name", "unused"}, {"uri", "absent.ies"}},
                     {{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}}});
    builder.push("nodes", {{"extensions", {{"EXT_lights_ies", {{"light", 1}}}}}});
    Json& node = builder.json["nodes"][0];
    node["name"] = "lamp";
    Json& use = node["extensions"]["EXT_lights_ies"];
    use["light"] = 1;
    use["multiplier"] = 2;
    use["color"] = {1, 0.5, 3};
    builder.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.lights.size(), 2u);
    ASSERT_EQ(scene.profiles.size(), 1u);
    EXPECT_EQ(scene.lights[0].name, "lamp");
    EXPECT_EQ(scene.lights[0].kind, PunctualLight::Kind::point);
    EXPECT_EQ(intensity_towards(scene, scene.lights[0], {0, 0, -1}), glm::vec3(60, 30, 60));
    EXPECT_EQ(intensity_towards(scene, scene.lights[1], {0, 0, -1}), glm::vec3(30));
    EXPECT_EQ(intensity_towards(scene, scene.lights[1], {0, 0, 1}), glm::vec3(0));

    use["light"] = 2;
    EXPECT_TRUE(contains(error_of(builder), "refers to lights[2]"));
    use["light"] = 0;
    EXPECT_TRUE(contains(error_of(builder), "absent.ies"));
}

TEST(Nodes, APunctualLightWithAProfileIsOneLamp)
{
    const std::string ies = "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n0 90 0 30 30\n";
    GltfBuilder builder = one_triangle();
    const int view = builder.add_view(ies.data(), ies.size());
    builder.json["extensions"]["EXT_lights_ies"]["lights"][0]["bufferView"] = view;
    Json& light = builder.json["extensions"]["KHR_lights_punctual"]["lights"][0];
    light = {
        {"type", "spot"}, {"intensity", 900}, {"color", {1, 0.5, 0}}, {"spot", Json::object()}};
    builder.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}},
                                              {"EXT_lights_ies", {{"light", 0}}}};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, PunctualLight::Kind::spot);
    EXPECT_EQ(intensity_towards(scene, scene.lights[0], {0, 0, -1}), glm::vec3(30, 15, 0));
    light["type"] = "directional";
    EXPECT_TRUE(contains(error_of(builder), "directional light"));
}

TEST(Nodes, LightsThatMakeNoSenseAreErrors)
{
    GltfBuilder builder = one_triangle();
    Json& light = builder.json["extensions"]["KHR_lights_punctual"]["lights"][0];
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    light = {{"type", "moon"}};
    EXPECT_TRUE(contains(error_of(builder), "/extensions/KHR_lights_punctual/lights/0/type"));
    light = {{"type", "point"}, {"intensity", -1}};
    EXPECT_TRUE(contains(error_of(builder), "negative"));
    light = {{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}};
    EXPECT_TRUE(contains(error_of(builder), "cone angles"));
}

TEST(Nodes, CamerasAreReadWithTheirPlace)
{
    GltfBuilder builder = one_triangle();
    builder.push("cameras", {{"type", "perspective"},
                             {"perspective", {{"yfov", 1.2}, {"aspectRatio", 2}, {"znear", 0.1}}}});
    builder.push("cameras",
                 {{"type", "orthographic"},
                  {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}});
    builder.push("nodes", {{"camera", 0}, {"name", "eye"}, {"translation", {0, 0, 4}}});
    builder.push("nodes", {{"camera", 1}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = builder.read();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov, 1.2f);
    EXPECT_FLOAT_EQ(scene.cameras[0].aspect, 2.0f);
    EXPECT_EQ(glm::vec3(scene.cameras[0].transform[3]), glm::vec3(0, 0, 4));
    EXPECT_FLOAT_EQ(scene.cameras[1].orthographic_height, 4.0f);
    EXPECT_FLOAT_EQ(scene.cameras[1].aspect, 1.5f);
}

TEST(Nodes, ExtrasSetTheDensityOfTheirLightmap)
{
    const Json fine = {{"lumel", {{"texels_per_metre", 40}}}};
    const Json coarse = {{"lumel", {{"texels_per_metre", 2.5}}}};
    GltfBuilder builder = one_triangle();
    EXPECT_EQ(builder.read().instances[0].texels_per_metre, 0.0f);
    builder.json["meshes"][0]["extras"] = coarse;
    EXPECT_EQ(builder.read().instances[0].texels_per_metre, 2.5f);
    builder.json["nodes"][0]["extras"] = fine;
    EXPECT_EQ(builder.read().instances[0].texels_per_metre, 40.0f);
    builder.push("materials", {{"extras", coarse}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_EQ(builder.read().materials[0].texels_per_metre, 2.5f);
    builder.json["nodes"][0]["extras"]["lumel"]["texels_per_metre"] = 0;
    EXPECT_TRUE(contains(error_of(builder), "/nodes/0/extras/lumel/texels_per_metre"));
    builder.json["nodes"][0]["extras"] = {{"lumel", "anything"}};
    EXPECT_EQ(builder.read().instances[0].texels_per_metre, 2.5f);
}
