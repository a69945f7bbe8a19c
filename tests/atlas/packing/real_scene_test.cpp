// What holds for scenes made in code holds for scenes from files.

#include <filesystem>

#include <gtest/gtest.h>

#include "../../support/source_folder.h"
#include "shapes.h"

namespace lumel::test {
namespace {

/// Reads a scene and makes all of it opaque, so that its area is that of its triangles.
Scene read_opaque(const std::filesystem::path& path)
{
    Scene scene = read_gltf(path.string());
    for (Material& material : scene.materials)
        material.alpha_mode = AlphaMode::opaque;
    return scene;
}

void expect_sound(const Scene& scene, int size)
{
    const Atlas atlas = make_atlas(scene, {.size = size});
    int shared = 0;
    texel_owners(atlas, shared);
    EXPECT_EQ(shared, 0);
    EXPECT_NEAR(front_area(make_lumels(scene, atlas)) / world_area(scene), 1.0, 1e-4);
}

TEST(RealScene, OurOwnScenesAreCoveredWithoutSharedTexels)
{
    const std::filesystem::path folder(support::source_path("scenes"));
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".gltf")
            continue;
        SCOPED_TRACE(entry.path().filename().string());
        expect_sound(read_opaque(entry.path()), 128);
    }
}

TEST(RealScene, AFurnishedClassroomIsCoveredWithoutSharedTexels)
{
    const std::filesystem::path path(
        support::data_path("interiors/japanese_classroom/japanese_classroom.glb"));
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << "needs " << path.filename() << " of the test data";
    expect_sound(read_opaque(path), 256);
}

}  // namespace
}  // namespace lumel::test
