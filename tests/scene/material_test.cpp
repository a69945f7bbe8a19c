// Materials as in the file, and their values at a point.

#include <cmath>

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/load/albedo_cap.h"

using namespace lumel;
using namespace lumel::test;

namespace {

constexpr glm::vec2 kNowhere[2] = {glm::vec2(0.0f), glm::vec2(0.0f)};

/// One triangle with the given material.
GltfBuilder with_material(const Json& material)
{
    GltfBuilder builder = one_triangle();
    builder.push("materials", material);
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    return builder;
}

/// Two texels side by side (black, then white), read as base colour.
GltfBuilder with_black_and_white(const Json& info = {{"index", 0}}, const Json& sampler = nullptr)
{
    GltfBuilder builder = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}});
    const Bytes png = make_png(2, 1, {0, 0, 0, 255, 255, 255, 255, 255});
    const int view = builder.add_view(png.data(), png.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    builder.push("textures", {{"source", 0}});
    if (!sampler.is_null()) {
        builder.push("samplers", sampler);
        builder.json["textures"][0]["sampler"] = 0;
    }
    builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", 5126, 3);
    auto& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = 1;
    attributes["TEXCOORD_1"] = 1;
    return builder;
}

/// The file's colour, without a cap.
float albedo_at(Scene scene, float u, float v)
{
    scene.max_albedo = 1.0f;
    const glm::vec2 texcoord[2] = {{u, v}, {0, 0}};
    return sample_material(scene, 0, texcoord, glm::vec4(1)).albedo.g;
}

}  // namespace

TEST(Materials, AMeshWithoutMaterialIsWhiteAndOpaque)
{
    const Scene scene = one_triangle().read();
    ASSERT_EQ(scene.materials.size(), 1u);
    const MaterialSample sample = sample_material(scene, 0, kNowhere, glm::vec4(1));
    EXPECT_EQ(sample.albedo, glm::vec3(kMaxAlbedo));
    EXPECT_EQ(sample.opacity, 1.0f);
    EXPECT_EQ(sample.emitted, glm::vec3(0));
    EXPECT_TRUE(is_uniform(scene.materials[0]));
}

TEST(Materials, FactorsAndVertexColoursMultiply)
{
    const Scene scene =
        with_material({{"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.5, 0.25, 1, 0.5}}, {"metallicFactor", 1}}},
                       {"doubleSided", true}})
            .read();
    const MaterialSample sample =
        sample_material(scene, 0, kNowhere, glm::vec4(0.5f, 1.0f, 0.0f, 1.0f));
    EXPECT_EQ(sample.albedo, glm::vec3(0.25f, 0.25f, 0.0f));
    EXPECT_EQ(sample.opacity, 1.0f);
    EXPECT_TRUE(scene.materials[0].double_sided);
}

TEST(Materials, EmissiveStrengthScalesTheFactor)
{
    const Scene scene =
        with_material(
            {{"emissiveFactor", {1, 0.5, 0}},
             {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 40}}}}}})
            .read();
    EXPECT_EQ(sample_material(scene, 0, kNowhere, glm::vec4(1)).emitted, glm::vec3(40, 20, 0));
}

TEST(Materials, OneThatIsTooBrightIsNamed)
{
    const auto read = [](double strength) {
        return with_material(
                   {{"name", "ceiling panel"},
                    {"emissiveFactor", {1, 1, 1}},
                    {"extensions",
                     {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}})
            .read();
    };
    EXPECT_EQ(read(1.6e9).materials.front().emitted.x, 1.6e9f);  // the sun's disc
    try {
        read(1e30);
        FAIL();
    } catch (const Error& error) {
        EXPECT_TRUE(contains(error.what(), "/materials/0: \"ceiling panel\" emits"))
            << error.what();
    }
}

TEST(Materials, ReflectAtMostTheMaximumInTheHueOfTheFile)
{
    Scene scene = with_material({{"name", "paper"},
                                 {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.8, 0.5, 1}}}},
                                 {"extensions",
                                  {{"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}}}})
                      .read();
    const auto reflected = [&] {
        const MaterialSample sample = sample_material(scene, 0, kNowhere, glm::vec4(1));
        return sample.opacity * sample.albedo;
    };
    const glm::vec3 color(1.0f, 0.8f, 0.5f);
    EXPECT_EQ(reflected(), 0.5f * 0.95f * color);
    const std::string before = scene.hash;
    cap_albedo(scene, 1.0f);
    EXPECT_EQ(reflected(), 0.5f * color);
    EXPECT_EQ(scene.warnings, std::vector<std::string>{});
    EXPECT_NE(scene.hash, before);
    cap_albedo(scene, 0.4f);
    cap_albedo(scene, 0.4f);
    EXPECT_EQ(reflected(), 0.5f * 0.4f * color);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_TRUE(contains(scene.warnings[0], "40 % (--max-albedo): \"paper\"")) << scene.warnings[0];
    EXPECT_EQ(glm::vec3(scene.materials[0].base_color), color);
}

TEST(Materials, OfClearGlassAreNotTooBright)
{
    Scene scene = with_material({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}},
                                 {"extensions",
                                  {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}}}}})
                      .read();
    cap_albedo(scene, 0.95f);
    EXPECT_EQ(scene.warnings, std::vector<std::string>{});
}

TEST(Materials, OfGlossReflectAtMostTheMaximumInAll)
{
    for (const float metallic : {0.0f, 0.3f, 1.0f}) {
        const Scene scene =
            with_material({{"pbrMetallicRoughness", {{"metallicFactor", metallic}}}})
                .read(MaterialModel::glossy);
        const MaterialSample sample = sample_material(scene, 0, kNowhere, glm::vec4(1));
        EXPECT_FLOAT_EQ(sample.diffuse.g + sample.specular.g, kMaxAlbedo);
    }
}

// The mapping of docs/methods.md, "Gloss".
TEST(Materials, DielectricsReflectF0AndMetalsTheirColour)
{
    const auto sample = [](float metallic, const Json& extensions) {
        const Scene scene = with_material({{"pbrMetallicRoughness",
                                            {{"baseColorFactor", {0.8, 0.4, 0.2, 1}},
                                             {"metallicFactor", metallic},
                                             {"roughnessFactor", 0.3}}},
                                           {"extensions", extensions}})
                                .read(MaterialModel::glossy);
        return sample_material(scene, 0, kNowhere, glm::vec4(1));
    };
    const Json none = Json::object();
    const MaterialSample plastic = sample(0.0f, none), metal = sample(1.0f, none);
    EXPECT_FLOAT_EQ(plastic.specular.r, 0.04f);
    EXPECT_FLOAT_EQ(plastic.diffuse.r, 0.96f * 0.8f);
    EXPECT_FLOAT_EQ(plastic.roughness, 0.3f);
    EXPECT_EQ(metal.specular, glm::vec3(0.8f, 0.4f, 0.2f));
    EXPECT_EQ(metal.diffuse, glm::vec3(0.0f));

    // Diamond, and half of ordinary glass in red.
    const MaterialSample diamond = sample(0.0f, {{"KHR_materials_ior", {{"ior", 2.4}}}});
    EXPECT_NEAR(diamond.specular.g, std::pow(1.4f / 3.4f, 2.0f), 1e-6f);
    const MaterialSample red =
        sample(0.0f, {{"KHR_materials_specular",
                       {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0, 0}}}}});
    EXPECT_FLOAT_EQ(red.specular.r, 0.02f);
    EXPECT_EQ(red.specular.g, 0.0f);

    for (const MaterialSample& any : {plastic, metal, diamond, red})
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(any.diffuse[c] + any.specular[c], 1.0f);
}

TEST(Materials, AlphaModesDecideOpacity)
{
    const auto opacity = [](const char* mode, float alpha) {
        GltfBuilder builder =
            with_material({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}},
                           {"alphaMode", mode},
                           {"alphaCutoff", 0.4}});
        return sample_material(builder.read(), 0, kNowhere, glm::vec4(1)).opacity;
    };
    EXPECT_EQ(opacity("OPAQUE", 0.2f), 1.0f);
    EXPECT_EQ(opacity("MASK", 0.39f), 0.0f);
    EXPECT_EQ(opacity("MASK", 0.41f), 1.0f);
    EXPECT_FLOAT_EQ(opacity("BLEND", 0.2f), 0.2f);
}

TEST(Materials, MetallicAndRoughnessTexelsAreLinear)
{
    Scene scene;
    scene.max_albedo = 1.0f;
    scene.textures.push_back({1, 1, {255, 51, 102, 255}});
    scene.materials.push_back({.roughness = 0.5f, .metallic_roughness_texture = {.texture = 0}});
    const MaterialSample sample = sample_material(scene, 0, kNowhere, glm::vec4(1));
    EXPECT_FLOAT_EQ(sample.roughness, 0.5f * 51.0f / 255.0f);
    EXPECT_FLOAT_EQ(sample.specular.r, 0.6f * 0.04f + 102.0f / 255.0f);
}

TEST(Materials, SrgbTexelsAreDecodedByTheExactCurve)
{
    Scene scene;
    scene.materials.push_back({.base_color_texture = {.texture = 0}});
    for (int value : {0, 5, 10, 11, 128, 188, 255}) {
        const auto byte = std::uint8_t(value);
        scene.textures = {{1, 1, {byte, byte, byte, 255}}};
        const double c = value / 255.0;
        const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(albedo_at(scene, 0.5f, 0.5f), linear, 1e-6);
    }
}

TEST(Materials, TexturesAreInterpolatedInLinearLight)
{
    const Scene scene = with_black_and_white().read();
    EXPECT_FALSE(is_uniform(scene.materials[0]));
    EXPECT_NEAR(albedo_at(scene, 0.25f, 0.5f), 0.0f, 1e-6f);
    EXPECT_NEAR(albedo_at(scene, 0.5f, 0.5f), 0.5f, 1e-6f);
    EXPECT_NEAR(albedo_at(scene, 0.75f, 0.5f), 1.0f, 1e-6f);
}

TEST(Materials, WrapModesDecideWhatLiesOutside)
{
    const auto scene_with = [](int mode) {
        return with_black_and_white({{"index", 0}}, {{"wrapS", mode}, {"wrapT", mode}}).read();
    };
    const Scene repeat = scene_with(10497);
    EXPECT_NEAR(albedo_at(repeat, 1.25f, 0.5f), 0.0f, 1e-6f);
    EXPECT_NEAR(albedo_at(repeat, -0.25f, -7.5f), 1.0f, 1e-6f);
    EXPECT_NEAR(albedo_at(repeat, 0.0f, 0.5f), 0.5f, 1e-6f);
    const Scene clamped = scene_with(33071);
    EXPECT_NEAR(albedo_at(clamped, 1.25f, 0.5f), 1.0f, 1e-6f);
    EXPECT_NEAR(albedo_at(clamped, -3.0f, 0.5f), 0.0f, 1e-6f);
    const Scene mirrored = scene_with(33648);
    EXPECT_NEAR(albedo_at(mirrored, 1.25f, 0.5f), 1.0f, 1e-6f);
    EXPECT_NEAR(albedo_at(mirrored, -0.25f, 0.5f), 0.0f, 1e-6f);
    EXPECT_NEAR(albedo_at(mirrored, 2.25f, 0.5f), 0.0f, 1e-6f);
}

TEST(Materials, FarAndBrokenCoordinatesGiveSomeTexel)
{
    const Scene scene = with_black_and_white().read();
    for (float u : {1e30f, -1e30f, INFINITY, NAN}) {
        const float albedo = albedo_at(scene, u, u);
        EXPECT_TRUE(albedo >= 0.0f && albedo <= 1.0f);
    }
}

TEST(Materials, TextureTransformsScaleThenTurnThenMove)
{
    // The lower left quadrant, turned clockwise, as the extension's own text gives it.
    const Scene scene =
        with_black_and_white(
            {{"index", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}}}}}})
            .read();
    const glm::mat3& transform = scene.materials[0].base_color_texture.transform;
    const auto mapped = [&](float u, float v) { return glm::vec2(transform * glm::vec3(u, v, 1)); };
    EXPECT_NEAR(glm::distance(mapped(0, 0), glm::vec2(0, 1)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(mapped(1, 0), glm::vec2(0, 0.5f)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(mapped(0, 1), glm::vec2(0.5f, 1)), 0.0f, 1e-6f);
}

TEST(Materials, TextureTransformsMayChooseTheOtherCoordinates)
{
    Json info = {{"index", 0}, {"texCoord", 0}};
    info["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
    EXPECT_EQ(with_black_and_white(info).read().materials[0].base_color_texture.texcoord, 1);
    info["extensions"]["KHR_texture_transform"]["texCoord"] = 4;
    EXPECT_TRUE(contains(error_of(with_black_and_white(info)), "TEXCOORD_4"));
}

TEST(Materials, SpecularGlossinessGivesItsDiffuseColour)
{
    const Scene scene =
        with_material(
            {{"extensions",
              {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.1, 0.2, 0.3, 1}}}}}}})
            .read();
    EXPECT_EQ(scene.materials[0].base_color, glm::vec4(0.1f, 0.2f, 0.3f, 1));
}

TEST(Materials, ImagesAreDecodedOnceAndOnlyWhereUsed)
{
    GltfBuilder builder = with_black_and_white();
    builder.push("textures", {{"source", 0}});
    builder.json["materials"][0]["emissiveTexture"] = {{"index", 1}};
    builder.push("images", {{"uri", "not_there.png"}});
    builder.push("textures", {{"source", 1}});
    builder.json["materials"][0]["normalTexture"] = {{"index", 2}};
    builder.push("materials", {{"emissiveTexture", {{"index", 2}}}});
    const Scene scene = builder.read();
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[0].base_color_texture.texture, 0);
    EXPECT_EQ(scene.materials[0].emissive_texture.texture, 0);
}

TEST(Materials, ATexturedMeshWithoutTexcoordsIsReadWithAWarning)
{
    GltfBuilder builder = with_black_and_white();
    builder.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    EXPECT_TRUE(warns(builder.read(), "texture coordinates"));
}

TEST(Materials, TransmissionLetsTheBaseColourThrough)
{
    const auto scene_of = [](const char* mode, float alpha, const Json& transmission) {
        return with_material({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, alpha}}}},
                              {"alphaMode", mode},
                              {"extensions", {{"KHR_materials_transmission", transmission}}}})
            .read();
    };
    const auto transmittance = [&](const char* mode, float alpha, float factor) {
        const Scene scene = scene_of(mode, alpha, {{"transmissionFactor", factor}});
        const MaterialSample sample = sample_material(scene, 0, kNowhere, glm::vec4(1));
        return (1.0f - sample.opacity) * sample.tint;
    };
    const auto expect = [](const glm::vec3& value, const glm::vec3& truth) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(value[c], truth[c], 1e-6f);
    };
    expect(transmittance("OPAQUE", 0.3f, 0.0f), {0.0f, 0.0f, 0.0f});
    expect(transmittance("OPAQUE", 0.3f, 1.0f), {1.0f, 0.5f, 0.0f});
    expect(transmittance("OPAQUE", 0.3f, 0.8f), {0.8f, 0.4f, 0.0f});
    expect(transmittance("MASK", 0.3f, 0.8f), {1.0f, 1.0f, 1.0f});
    expect(transmittance("BLEND", 0.25f, 0.0f), {0.75f, 0.75f, 0.75f});
    expect(transmittance("BLEND", 0.25f, 0.8f), {0.95f, 0.85f, 0.75f});

    const Scene scene = scene_of("OPAQUE", 1.0f, {{"transmissionFactor", 1}});
    EXPECT_TRUE(may_be_transparent(scene.materials[0], scene.meshes[0].primitives[0]));
    EXPECT_TRUE(is_coloured_glass(scene.materials[0]));
    EXPECT_EQ(scene.warnings, std::vector<std::string>{});
}

TEST(Materials, ATransmissionTextureIsNotReadWhichIsSaid)
{
    GltfBuilder builder =
        with_material({{"extensions",
                        {{"KHR_materials_transmission",
                          {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}}}}});
    builder.push("textures", Json::object());
    const Scene scene = builder.read();
    EXPECT_TRUE(warns(scene, "transmission texture"));
}

TEST(Materials, TexturesThatNeedAnotherFormatAreRefusedByName)
{
    constexpr const char* kBasis = "KHR_texture_basisu";
    GltfBuilder builder = with_black_and_white();
    builder.json["textures"][0]["extensions"][kBasis]["source"] = 0;
    EXPECT_EQ(error_of(builder), "") << "the plain source is there";
    builder.json["textures"][0].erase("source");
    EXPECT_TRUE(contains(error_of(builder), kBasis));
}

TEST(Materials, ValuesThatMakeNoSenseAreErrors)
{
    const auto error_with = [](const Json& material) { return error_of(with_material(material)); };
    EXPECT_TRUE(contains(error_with({{"alphaMode", "GLASS"}}), "/materials/0/alphaMode"));
    EXPECT_TRUE(contains(error_with({{"emissiveFactor", {-1, 0, 0}}}), "negative"));
    EXPECT_TRUE(contains(error_with({{"emissiveFactor", 1}}), "must be a JSON array"));
    EXPECT_TRUE(contains(error_with({{"emissiveTexture", {{"index", 3}}}}), "textures[3]"));
    EXPECT_TRUE(contains(error_with({{"pbrMetallicRoughness", 1}}), "must be a JSON object"));
    EXPECT_TRUE(contains(error_with({{"doubleSided", 1}}), "true or false"));
    EXPECT_TRUE(contains(error_of(with_black_and_white({{"index", 0}}, {{"wrapS", 1}})),
                         "/samplers/0/wrapS"));
}
