// lamps.json: what is read, and the sentence about each mistake.

#include <gtest/gtest.h>

#include "../../support/input_error.h"
#include "results/page/lamp_list.h"

namespace lumel {
namespace {

const std::string kFile = "out/lamps.json";

Json lamp(const std::string& name, const std::string& map)
{
    return {{"name", name}, {"kind", "spot"},           {"members", {name}},
            {"unit", "lx"}, {"color", {1.0, 0.9, 0.7}}, {"error", 0.013},
            {"map", map}};
}

std::vector<ListedLamp> read(const Json& json, int pages = 1)
{
    return lamps_of(JsonView(kFile, json), pages);
}

std::string refusal(const Json& json, int pages = 1)
{
    return test::input_error_of([&] { read(json, pages); });
}

TEST(LampList, HoldsLampsInTheirOrder)
{
    Json joined = lamp("kitchen <b>\"🙂\"", "lamps/kitchen.exr");
    joined["kind"] = "group";
    joined["members"] = {"lamp_k1", "lamp_k2"};
    joined.erase("error");
    const auto lamps =
        read({{"lamps", {lamp("desk", "lamps/desk.exr"), joined}}, {"sum_error", 0}});
    ASSERT_EQ(lamps.size(), 2u);
    EXPECT_EQ(lamps[0].map, "lamps/desk");
    EXPECT_EQ(lamps[0].error, 0.013);
    EXPECT_EQ(lamps[0].color, glm::dvec3(1.0, 0.9, 0.7));
    EXPECT_EQ(lamps[1].name, "kitchen <b>\"🙂\"");
    EXPECT_EQ(lamps[1].members, (std::vector<std::string>{"lamp_k1", "lamp_k2"}));
    EXPECT_FALSE(lamps[1].error);
}

TEST(LampList, NamesTheFirstPageOfMapsWithSeveral)
{
    EXPECT_EQ(read({{"lamps", {lamp("a", "lamps/a-0.exr")}}}, 2)[0].map, "lamps/a");
    EXPECT_EQ(refusal({{"lamps", {lamp("a", "lamps/a.exr")}}}, 2),
              "out/lamps.json: /lamps/0/map: is \"lamps/a.exr\", but must end with -0.exr");
}

TEST(LampList, RefusesWhatIsWrongInASentenceThatNamesIt)
{
    const auto changed = [](const char* member, const Json& value) {
        Json one = lamp("a", "lamps/a.exr");
        one[member] = value;
        return Json{{"lamps", {one}}};
    };
    const auto expect = [&](const Json& json, const std::string& place, const std::string& part) {
        const std::string said = refusal(json);
        EXPECT_NE(said.find(kFile + ": " + place), said.npos) << said;
        EXPECT_NE(said.find(part), said.npos) << said;
    };
    expect(Json::object(), "", "lamps");
    expect({{"lamps", Json::array()}}, "/lamps", "has 0 lamps, but must have 1 to 64");
    expect(changed("name", 7), "/lamps/0/name", "string");
    expect(changed("name", ""), "/lamps/0/name", "must not be empty");
    expect(changed("kind", "candle"), "/lamps/0/kind", "candle");
    expect(changed("color", {1, 1}), "/lamps/0/color", "must be [r, g, b]");
    expect(changed("color", {1, 1, 2}), "/lamps/0/color/2", "must lie in");
    expect(changed("error", -1), "/lamps/0/error", "must lie in");
    expect(changed("members", "a"), "/lamps/0/members", "");
    expect(changed("map", "a.png"), "/lamps/0/map", "must end with .exr");
    expect(changed("map", "../a.exr"), "/lamps/0/map", "in the folder of the bake");
    expect(changed("map", "/a.exr"), "/lamps/0/map", "in the folder of the bake");
    expect({{"lamps", {lamp("a", "a.exr"), lamp("a", "b.exr")}}}, "/lamps/1/name",
           "second lamp named");
    Json many = {{"lamps", Json::array()}};
    for (int i = 0; i < 65; ++i)
        many["lamps"].push_back(lamp(std::to_string(i), "a.exr"));
    expect(many, "/lamps", "has 65 lamps");
}

}  // namespace
}  // namespace lumel
