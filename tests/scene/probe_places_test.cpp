// Places for light probes that a file names.

#include "scene/load/probe_places.h"

#include <gtest/gtest.h>

#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace {

const Json kWanted = {{"lumel", {{"probe", true}}}};

}  // namespace

TEST(ProbePlaces, AreTheNodesThatSaySoWhereTheirParentsPutThem)
{
    const TempFolder folder;
    GltfBuilder builder = one_triangle();
    const int child = builder.push(
        "nodes", {{"name", "by the window"}, {"translation", {1, 0, 0}}, {"extras", kWanted}});
    const int parent = builder.push(
        "nodes", {{"translation", {0, 5, 0}}, {"scale", {2, 2, 2}}, {"children", {child}}});
    const int plain = builder.push(
        "nodes", {{"extras", {{"lumel", {{"probe", false}}}}}, {"translation", {9, 9, 9}}});
    builder.json["scenes"][0]["nodes"].push_back(parent);
    builder.json["scenes"][0]["nodes"].push_back(plain);
    builder.push("nodes", {{"name", "in no scene"}, {"extras", kWanted}});
    const std::vector<ProbePlace> places = probe_places(builder.write(folder));
    ASSERT_EQ(places.size(), 1u);
    EXPECT_EQ(places[0].name, "by the window");
    EXPECT_EQ(places[0].position, glm::dvec3(2.0, 5.0, 0.0));
}

TEST(ProbePlaces, AreAskedForByYesOrNoAlone)
{
    const TempFolder folder;
    GltfBuilder builder = one_triangle();
    builder.json["nodes"][0]["extras"] = {{"lumel", {{"probe", 1}}}};
    const std::string path = builder.write(folder);
    try {
        probe_places(path);
        FAIL() << "it was read";
    } catch (const Error& error) {
        EXPECT_TRUE(contains(error.what(), "/nodes/0/extras/lumel/probe")) << error.what();
    }
    builder.json["nodes"][0]["extras"] = {{"lumel", "probe"}};
    EXPECT_TRUE(probe_places(builder.write(folder)).empty());
}
