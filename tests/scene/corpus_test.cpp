// Real and hard files. The data is not part of the repository.

#include <algorithm>
#include <chrono>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace fs = std::filesystem;

namespace {

const fs::path kData = support::data_path("");

/// All glTF files below a folder, sorted; empty where the data is absent.
std::vector<std::string> files_below(const std::string& folder)
{
    std::vector<std::string> files;
    std::error_code absent;
    for (const auto& entry : fs::recursive_directory_iterator(kData / folder, absent)) {
        const std::string extension = entry.path().extension();
        if (extension == ".gltf" || extension == ".glb")
            files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string text_of(const std::string& path)
{
    std::ifstream stream(path, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The extension that a valid file may be refused for, empty if it must be read.
std::string refused_extension(const std::string& path)
{
    const std::string text = text_of(path);
    for (const char* name : {"KHR_texture_basisu", "FAKE_materials_quantumRendering"})
        if (contains(text, name))
            return name;
    return "";
}

/// Valid files without a triangle (points and lines), for a later glTF version, or one whose
/// bufferViews reach beyond their buffer.
bool must_fail(const std::string& path)
{
    for (const char* name :
         {"PrimitiveMode_00", "PrimitiveMode_01", "PrimitiveMode_02", "PrimitiveMode_03",
          "PrimitiveMode_07", "PrimitiveMode_08", "PrimitiveMode_09", "PrimitiveMode_10",
          "Compatibility_04", "teapots_galore_id.gltf"})
        if (contains(path, name))
            return true;
    return false;
}

void expect_sound(const Scene& scene)
{
    ASSERT_FALSE(scene.instances.empty());
    EXPECT_EQ(scene.hash.size(), 16u);
    for (const Instance& instance : scene.instances) {
        ASSERT_LT(std::size_t(instance.mesh), scene.meshes.size());
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives) {
            ASSERT_LT(std::size_t(primitive.material), scene.materials.size());
            const std::size_t count = primitive.positions.size();
            for (std::size_t length :
                 {primitive.normals.size(), primitive.colors.size(), primitive.texcoords[0].size(),
                  primitive.texcoords[1].size()})
                EXPECT_TRUE(length == 0 || length == count);
            EXPECT_EQ(primitive.indices.size() % 3, 0u);
            EXPECT_FALSE(primitive.indices.empty());
            for (std::uint32_t index : primitive.indices)
                ASSERT_LT(index, count);
        }
    }
    for (const Material& material : scene.materials)
        for (const TextureUse* use : {&material.base_color_texture, &material.emissive_texture})
            EXPECT_LT(use->texture, int(scene.textures.size()));
}

}  // namespace

TEST(Corpus, ValidFilesAreReadOrRefusedByName)
{
    std::size_t count = 0;
    for (const char* folder : {"gltf_conformance", "cornell", "analytic", "interiors"})
        for (const std::string& path : files_below(folder)) {
            SCOPED_TRACE(path);
            ++count;
            const std::string extension = refused_extension(path);
            const std::string error = error_of_file(path);
            if (!extension.empty())
                EXPECT_TRUE(contains(error, extension)) << error;
            else if (must_fail(path))
                EXPECT_NE(error, "");
            else if (error.empty())
                expect_sound(read_gltf(path));
            else
                ADD_FAILURE() << error;
        }
    if (count == 0)
        GTEST_SKIP() << "the test data is absent";
}

TEST(Corpus, InvalidFilesNeverEndInAnythingButAnError)
{
    // Read although something in them is wrong, because nothing that decides the light is:
    // broken normals are repaired, names and normal maps are not looked at, texture
    // coordinates may be missing.
    const std::set<std::string> harmless = {"BoxBadNormals.glb", "badString.gltf", "badNumber.gltf",
                                            "texcoord_crash.gltf"};
    const auto files = files_below("gltf_invalid");
    if (files.empty())
        GTEST_SKIP() << "the test data is absent";
    for (const std::string& path : files) {
        const bool read = harmless.contains(fs::path(path).filename());
        const std::string error = error_of_file(path);
        EXPECT_EQ(error.empty(), read) << path << ": " << error;
        EXPECT_TRUE(read || contains(error, fs::path(path).filename().string())) << error;
    }
}

TEST(Corpus, SponzaLoadsWholeAndInSeconds)
{
    const std::string path = (kData / "crytek_sponza/sponza.glb").string();
    if (!fs::exists(path))
        GTEST_SKIP() << "the test data is absent";
    const auto start = std::chrono::steady_clock::now();
    const Scene scene = read_gltf(path);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::size_t triangles = scene.dropped_triangles;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives)
            triangles += primitive.indices.size() / 3;
    EXPECT_EQ(triangles, 262267u);
    EXPECT_EQ(scene.textures.size(), 25u);
    EXPECT_LT(seconds.count(), 30.0);
    EXPECT_EQ(scene.hash, read_gltf(path).hash);
}

TEST(Corpus, PackagingsOfOneBoxDecodeToTheSameContent)
{
    const std::string folder = (kData / "gltf_conformance/assimp").string();
    if (!fs::exists(folder))
        GTEST_SKIP() << "the test data is absent";
    const std::string binary = read_gltf(folder + "/BoxTextured-glTF-Binary/BoxTextured.glb").hash;
    EXPECT_EQ(read_gltf(folder + "/BoxTextured-glTF-Embedded/BoxTextured.gltf").hash, binary);
}

TEST(Corpus, StripsFansAndListsShowTheSameSquare)
{
    const auto files = files_below("gltf_conformance/asset_generator/Mesh_PrimitiveMode");
    if (files.empty())
        GTEST_SKIP() << "the test data is absent";
    for (const std::string& path : files) {
        if (must_fail(path))
            continue;
        const Scene scene = read_gltf(path);
        double area = 0.0;
        for (const Primitive& primitive : scene.meshes.at(0).primitives)
            for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
                const auto corner = [&](std::size_t k) {
                    return primitive.positions[primitive.indices[i + k]];
                };
                const glm::vec3 cross = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
                EXPECT_GT(cross.z, 0.0f) << path;
                area += 0.5 * glm::length(cross);
            }
        EXPECT_NEAR(area, 1.0, 1e-5) << path;
    }
}
