// EXT_lights_area: shapes that shine from one side.

#include <numbers>

#include <gtest/gtest.h>

#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace {

constexpr const char* kAreaLights = "EXT_lights_area";

/// A triangle, and a node with an area light.
GltfBuilder lit_by(const Json& light)
{
    GltfBuilder builder = one_triangle();
    builder.json["extensions"][kAreaLights]["lights"] = Json::array({light});
    builder.json["extensionsUsed"] = {kAreaLights};
    builder.json["extensionsRequired"] = {kAreaLights};
    const int node =
        builder.push("nodes", {{"name", "panel"}, {"extensions", {{kAreaLights, {{"light", 0}}}}}});
    builder.json["scenes"][0]["nodes"].push_back(node);
    return builder;
}

GltfBuilder rectangle()
{
    return lit_by({{"type", "rect"}, {"size", 2}, {"rect", {{"aspect", 1.5}}}, {"intensity", 300}});
}

const Primitive& shape_of(const Scene& scene)
{
    return scene.meshes[std::size_t(scene.instances.at(1).mesh)].primitives.at(0);
}

/// Sum of the triangles' area vectors in the world [m²].
glm::vec3 area_vector(const Scene& scene)
{
    const Primitive& shape = shape_of(scene);
    const auto corner = [&](std::size_t i) {
        return glm::vec3(scene.instances[1].transform *
                         glm::vec4(shape.positions[shape.indices[i]], 1.0f));
    };
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < shape.indices.size(); i += 3)
        sum += 0.5f * glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i));
    return sum;
}

void expect_area(const Scene& scene, const glm::vec3& vector)
{
    EXPECT_NEAR(glm::distance(area_vector(scene), vector), 0.0f, 1e-5f * glm::length(vector));
}

std::string error_with(const Json& light)
{
    return error_of(lit_by(light));
}

}  // namespace

TEST(AreaLights, ARectangleIsABlackSurfaceThatEmitsTowardsMinusZ)
{
    const Scene scene = rectangle().read();
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[1].name, "panel");
    expect_area(scene, {0.0f, 0.0f, -6.0f});
    const Material& material = scene.materials[std::size_t(shape_of(scene).material)];
    EXPECT_EQ(material.emitted, glm::vec3(300.0f));
    EXPECT_EQ(material.base_color, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    EXPECT_FALSE(material.double_sided);
    EXPECT_TRUE(scene.lights.empty());
    // Off a ceiling that the light lies in.
    for (const glm::vec3& position : shape_of(scene).positions)
        EXPECT_LT(position.z, 0.0f);
}

TEST(AreaLights, ADiskHasTheAreaOfItsCircle)
{
    const float pi = std::numbers::pi_v<float>;
    expect_area(lit_by({{"type", "disk"}, {"size", 3}}).read(), {0.0f, 0.0f, -2.25f * pi});
    const Json ellipse = {{"type", "disk"}, {"size", 3}, {"extras", {{"aspect", 2}}}};
    expect_area(lit_by(ellipse).read(), {0.0f, 0.0f, -4.5f * pi});
}

TEST(AreaLights, ColourAndIntensityAreTheLuminance)
{
    const Scene scene =
        lit_by({{"type", "rect"}, {"color", {1, 0.5, 0.25}}, {"intensity", 800}}).read();
    EXPECT_EQ(scene.materials[std::size_t(shape_of(scene).material)].emitted,
              glm::vec3(800.0f, 400.0f, 200.0f));
    EXPECT_EQ(lit_by({{"type", "rect"}, {"intensity", 0}}).read().instances.size(), 1u);
}

TEST(AreaLights, GrowByTheLargestScaleOfTheirNode)
{
    GltfBuilder builder = rectangle();
    builder.json["nodes"][1]["scale"] = {1, -3, 0.5};
    EXPECT_NEAR(glm::length(area_vector(builder.read())), 9.0f * 6.0f, 1e-3f);
    // A light turned over points along its own -z all the same.
    builder.json["nodes"][1]["scale"] = {1, 1, 1};
    builder.json["nodes"][1]["rotation"] = {0.70710678, 0, 0, 0.70710678};
    expect_area(builder.read(), {0.0f, 6.0f, 0.0f});
}

TEST(AreaLights, LightsOfOneKindShareAMesh)
{
    GltfBuilder builder = rectangle();
    builder.json["nodes"][0]["extensions"] = builder.json["nodes"][1]["extensions"];
    const Scene scene = builder.read();
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[1].mesh, scene.instances[2].mesh);
}

TEST(AreaLights, TheDocumentIsThatOfAPlainFile)
{
    const TempFolder folder;
    const GltfDocument document = load_gltf_document(rectangle().write(folder));
    EXPECT_FALSE(contains(document.json.dump(), kAreaLights)) << document.json.dump();
    EXPECT_EQ(document.json["extensionsUsed"], Json({"KHR_materials_emissive_strength"}));
}

TEST(AreaLights, TheirTexelsAreFewUnlessTheNodeSetsADensity)
{
    GltfBuilder builder = rectangle();
    EXPECT_NEAR(builder.read().instances[1].texels_per_metre, 8.0f / 3.0f, 1e-6f);
    builder.json["nodes"][1]["extras"]["lumel"]["texels_per_metre"] = 7;
    EXPECT_EQ(builder.read().instances[1].texels_per_metre, 7.0f);
}

TEST(AreaLights, WhatIsWrongIsSaidWithItsPlace)
{
    const auto expect = [](const std::string& error, const std::string& what) {
        EXPECT_TRUE(contains(error, std::string("/extensions/") + kAreaLights)) << error;
        EXPECT_TRUE(contains(error, what)) << error;
    };
    expect(error_with(Json::object()), "\"type\" is missing");
    expect(error_with({{"type", "ring"}}), "is \"ring\", but must be rect or disk");
    expect(error_with({{"type", "rect"}, {"size", 0}}), "/lights/0/size");
    expect(error_with({{"type", "rect"}, {"rect", {{"aspect", -1}}}}), "/lights/0/rect/aspect");
    expect(error_with({{"type", "rect"}, {"size", 1e6}, {"rect", {{"aspect", 1e6}}}}), "wider");
    expect(error_with({{"type", "disk"}, {"intensity", -1}}), "a negative or infinite amount");
    GltfBuilder builder = rectangle();
    builder.json["nodes"][1]["extensions"][kAreaLights]["light"] = 1;
    expect(error_of(builder), "/nodes/1/extensions");
    builder = rectangle();
    builder.json["nodes"][1]["children"] = 3;
    EXPECT_TRUE(contains(error_of(builder), "/nodes/1/children")) << error_of(builder);
}
