// Both sides of surfaces in what is written.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "../../support/source_folder.h"
#include "scene/gltf/accessor.h"
#include "two_quads.h"

namespace lumel {
namespace {

using test::TwoQuads;

// Each of the scene's surfaces has its back at another place of the map.
Atlas with_own_backs(Atlas atlas)
{
    atlas.back_shift.assign(atlas.chart_count, glm::ivec2(1, 2));
    return atlas;
}

/// The file as viewers read it, who know nothing of our marks.
std::string without_marks(const std::string& path, const std::string& copy)
{
    const std::vector<char> bytes = test::bytes_of(path);
    std::string text(bytes.begin(), bytes.end());
    const std::string mark = "\"lumel_side\"", unknown = "\"other_side\"";
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
        text.replace(at, mark.size(), unknown);
    std::ofstream(copy, std::ios::binary) << text;
    return copy;
}

/// Each element of an attribute.
std::vector<glm::vec4> attribute(const GltfDocument& document, const Json& primitive,
                                 const char* name)
{
    const std::vector<float> values =
        to_floats(read_accessor(document, primitive["attributes"][name].get<std::size_t>()));
    const std::size_t each = std::string(name) == "TANGENT" ? 4 : 3;
    std::vector<glm::vec4> elements(values.size() / each, glm::vec4(0.0f));
    for (std::size_t i = 0; i < values.size(); ++i)
        elements[i / each][int(i % each)] = values[i];
    return elements;
}

/// What a texel of a normal map makes of the normal.
glm::vec3 bent(const glm::vec3& normal, const glm::vec4& tangent, const glm::vec3& texel)
{
    return texel.x * glm::vec3(tangent) +
           texel.y * tangent.w * glm::cross(normal, glm::vec3(tangent)) + texel.z * normal;
}

// glTF turns the bent normal of double-sided materials where the back is seen.
TEST_F(TwoQuads, BacksBendTheirNormalsAsBacksOfDoubleSidedSurfacesDo)
{
    constexpr glm::vec3 kNormal(0.0f, 0.0f, 1.0f), kTexel(0.3f, 0.5f, 0.8f);
    constexpr glm::vec4 kTangent(0.6f, 0.8f, 0.0f, 1.0f);
    std::ofstream bytes(folder_ / "tangents.bin", std::ios::binary);
    for (int i = 0; i < 4; ++i)
        bytes.write(reinterpret_cast<const char*>(&kNormal), sizeof kNormal);
    for (int i = 0; i < 4; ++i)
        bytes.write(reinterpret_cast<const char*>(&kTangent), sizeof kTangent);
    bytes.close();
    Json json = file();
    json["buffers"].push_back({{"uri", "tangents.bin"}, {"byteLength", 112}});
    json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 48}});
    json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 48}, {"byteLength", 64}});
    json["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    json["accessors"].push_back(
        {{"bufferView", 3}, {"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
    json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
    json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = 3;
    json["materials"][0]["doubleSided"] = true;

    const Scene read = scene(json);
    const Atlas atlas = with_own_backs(test::corner_atlas(read));
    write_scene_glb(folder_ / "out.glb", load_gltf_document(read.path), read, atlas,
                    test::any_map(atlas));
    const GltfDocument written =
        load_gltf_document(without_marks(folder_ / "out.glb", folder_ / "viewed.glb"));
    const auto mesh = written.json["nodes"][0]["mesh"].get<std::size_t>();
    const Json& primitives = written.json["meshes"][mesh]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    const auto normals = attribute(written, primitives[1], "NORMAL"),
               tangents = attribute(written, primitives[1], "TANGENT");
    ASSERT_FALSE(normals.empty());
    ASSERT_EQ(normals.size(), tangents.size());
    for (std::size_t i = 0; i < normals.size(); ++i)
        EXPECT_LT(glm::distance(bent(glm::vec3(normals[i]), tangents[i], kTexel),
                                -bent(kNormal, kTangent, kTexel)),
                  1e-6f);
}

// The least whole number has no opposite, and stands for the same direction as the one after it.
template <class T>
void write_least_normals(const std::string& path)
{
    constexpr T kNormalAndFiller[4] = {0, 0, std::numeric_limits<T>::min(), 0};
    std::ofstream file(path, std::ios::binary);
    for (int vertex = 0; vertex < 4; ++vertex)
        file.write(reinterpret_cast<const char*>(kNormalAndFiller), sizeof kNormalAndFiller);
}

TEST_F(TwoQuads, NormalsOfBacksPointTheOtherWayInWholeNumbersToo)
{
    constexpr int kByte = 5120, kShort = 5122;
    write_least_normals<std::int8_t>(folder_ / "normals-5120.bin");
    write_least_normals<std::int16_t>(folder_ / "normals-5122.bin");
    for (const int type : {kByte, kShort}) {
        const int stride = type == kByte ? 4 : 8;
        Json json = file();
        json["extensionsUsed"].push_back("KHR_mesh_quantization");
        json["extensionsRequired"] = {"KHR_mesh_quantization"};
        json["buffers"].push_back(
            {{"uri", "normals-" + std::to_string(type) + ".bin"}, {"byteLength", 4 * stride}});
        json["bufferViews"].push_back(
            {{"buffer", 1}, {"byteLength", 4 * stride}, {"byteStride", stride}});
        json["accessors"].push_back({{"bufferView", 2},
                                     {"componentType", type},
                                     {"normalized", true},
                                     {"count", 4},
                                     {"type", "VEC3"}});
        json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
        json["materials"][0]["doubleSided"] = true;

        const Scene read = scene(json);
        const Atlas atlas = with_own_backs(test::corner_atlas(read));
        write_scene_glb(folder_ / "out.glb", load_gltf_document(read.path), read, atlas,
                        test::any_map(atlas));
        const Scene viewed = read_gltf(without_marks(folder_ / "out.glb", folder_ / "viewed.glb"));
        const Mesh& mesh = viewed.meshes[std::size_t(viewed.instances[0].mesh)];
        ASSERT_EQ(mesh.primitives.size(), 2u);
        for (const glm::vec3& normal : mesh.primitives[0].normals)
            EXPECT_EQ(normal, glm::vec3(0.0f, 0.0f, -1.0f)) << type;
        for (const glm::vec3& normal : mesh.primitives[1].normals)
            EXPECT_EQ(normal, glm::vec3(0.0f, 0.0f, 1.0f)) << type;
    }
}

TEST(GltfWrite, HasAFaceForEachSideAndIsReadAsDoubleSidedAgain)
{
    const test::TemporaryFolder folder;
    Json file = Json::parse(std::ifstream(support::source_path("scenes/cornell-box.gltf")));
    for (Json& material : file["materials"])
        material["doubleSided"] = true;
    std::ofstream(folder / "in.gltf") << file;
    const Scene scene = read_gltf(folder / "in.gltf");
    const Atlas atlas = with_own_backs(test::corner_atlas(scene));
    write_scene_glb(folder / "out.glb", load_gltf_document(scene.path), scene, atlas,
                    test::any_map(atlas), {});

    // As any viewer has it: two single-sided faces, turned away from each other, the second at the
    // place of the back.
    const Scene viewed = read_gltf(without_marks(folder / "out.glb", folder / "viewed.glb"));
    for (const Material& material : viewed.materials)
        EXPECT_FALSE(material.double_sided);
    ASSERT_EQ(viewed.instances.size(), scene.instances.size());
    for (const Instance& instance : viewed.instances) {
        const Mesh& mesh = viewed.meshes[std::size_t(instance.mesh)];
        ASSERT_EQ(mesh.primitives.size(), 2u);
        const Primitive &front = mesh.primitives[0], &back = mesh.primitives[1];
        ASSERT_EQ(front.indices.size(), back.indices.size());
        for (std::size_t k = 0; k < front.indices.size(); ++k) {
            const std::uint32_t a = front.indices[k], b = back.indices[k % 3 == 0   ? k
                                                                       : k % 3 == 1 ? k + 1
                                                                                    : k - 1];
            EXPECT_EQ(front.positions[a], back.positions[b]);
            EXPECT_EQ(front.normals[a], -back.normals[b]);
            const glm::vec2 apart = (back.texcoords[1][b] - front.texcoords[1][a]) *
                                    glm::vec2(atlas.width, atlas.height);
            EXPECT_NEAR(apart.x, 1.0f, 1e-3f);
            EXPECT_NEAR(apart.y, 2.0f, 1e-3f);
        }
    }

    const Scene read = read_gltf(folder / "out.glb");
    for (const Instance& instance : read.instances) {
        const Mesh& mesh = read.meshes[std::size_t(instance.mesh)];
        ASSERT_EQ(mesh.primitives.size(), 1u);
        EXPECT_TRUE(read.materials[std::size_t(mesh.primitives[0].material)].double_sided);
    }
}

}  // namespace
}  // namespace lumel
