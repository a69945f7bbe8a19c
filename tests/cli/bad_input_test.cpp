// Files that cannot be baked end in one sentence, exit code 2, and nothing written.

#include <gtest/gtest.h>

#include "program.h"

namespace lumel::test {
namespace {

void expect_refused(const Workplace& place, const std::string& scene,
                    const std::vector<std::string>& words)
{
    const std::vector<std::string> before = place.listing();
    for (const char* command : {"bake", "reference"}) {
        SCOPED_TRACE(command);
        expect_one_sentence(run_lumel({command, scene, place.path("out")}), 2, words);
        EXPECT_EQ(place.listing(), before);
    }
    SCOPED_TRACE("info");
    expect_one_sentence(run_lumel({"info", scene}), 2, words);
}

TEST(BadInput, AMissingFile)
{
    const Workplace place;
    expect_refused(place, place.path("nowhere.glb"), {"nowhere.glb"});
}

TEST(BadInput, ADirectory)
{
    const Workplace place;
    std::filesystem::create_directory(place.path("folder.glb"));
    expect_refused(place, place.path("folder.glb"), {"folder.glb"});
}

TEST(BadInput, AnEmptyFile)
{
    const Workplace place;
    expect_refused(place, place.file("empty.glb", ""), {"empty.glb"});
    expect_refused(place, place.file("empty.gltf", ""), {"empty.gltf"});
}

TEST(BadInput, AFileOfSomethingElse)
{
    const Workplace place;
    expect_refused(place, place.file("text.glb", "once upon a time there was a file"),
                   {"text.glb"});
}

TEST(BadInput, ATruncatedBinary)
{
    // The header promises 4096 bytes, of which there are 28.
    const std::string header("glTF\2\0\0\0\0\x10\0\0\0\x0c\0\0JSON{\"asset\"", 28);
    const Workplace place;
    expect_refused(place, place.file("cut.glb", header), {"cut.glb"});
}

TEST(BadInput, ARequiredExtensionWeDoNotKnow)
{
    const Workplace place;
    const std::string text = R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_warp_drive"],
                                 "extensionsRequired": ["ACME_warp_drive"]})";
    expect_refused(place, place.file("warp.gltf", text), {"warp.gltf", "ACME_warp_drive"});
}

TEST(BadInput, ASceneOfNothing)
{
    const Workplace place;
    expect_refused(place, place.file("void.gltf", R"({"asset": {"version": "2.0"}})"),
                   {"void.gltf"});
}

TEST(BadInput, BothSidesWhereTheLightOfEachSourceIsKept)
{
    const Workplace place;
    for (const char* sides : {"both", "auto"}) {
        const std::vector<std::string> what = {own_scene("sealed-box.gltf"),
                                               "--solver",
                                               "matrix",
                                               "--patches",
                                               "16",
                                               "--size",
                                               "16",
                                               "--sides",
                                               sides};
        std::vector<std::string> info = {"info"}, bake = {"bake"};
        info.insert(info.end(), what.begin(), what.end());
        bake.insert(bake.end(), what.begin(), what.end());
        bake.insert(bake.begin() + 2, place.path("out"));
        if (std::string(sides) == "both") {
            for (const auto& arguments : {info, bake})
                expect_one_sentence(run_lumel(arguments), 2, {"--sides both", "scene.lumelmat"});
            EXPECT_TRUE(place.listing().empty());
        } else {
            for (const auto& arguments : {info, bake})
                EXPECT_EQ(run_lumel(arguments).code, 0);
            EXPECT_TRUE(std::filesystem::exists(place.path("out/scene.lumelmat")));
        }
    }
}

TEST(BadInput, MapsToCompareMustBeExrFiles)
{
    const Workplace place;
    const std::string text = place.file("text.exr", "no picture");
    expect_one_sentence(run_lumel({"compare", text, text, "-o", place.path("heat.png")}), 2,
                        {"text.exr"});
    EXPECT_EQ(place.listing(), std::vector<std::string>{"text.exr"});
}

}  // namespace
}  // namespace lumel::test
