// daylight.json: what is read, and the sentence about each mistake.

#include <gtest/gtest.h>

#include "../../support/input_error.h"
#include "results/page/daylight_list.h"

namespace lumel {
namespace {

const std::string kFile = "out/daylight.json";

Json hour(const std::string& time, const Json& weights)
{
    return {{"hour", time},
            {"sun", {0.6, 0.8, 0.0}},
            {"lux", 1234.5},
            {"mean", 210.0},
            {"weights", weights}};
}

Json map(const std::string& time, const std::string& file)
{
    return {{"hour", time}, {"unit", "lx"}, {"map", file}};
}

Json document()
{
    return {{"place", {{"name", "Made"}, {"latitude", 47.5}, {"longitude", -19.0}}},
            {"error", 0.0085},
            {"maps", {map("06-21T12", "daylight-a.exr"), map("12-21T12", "daylight-b.exr")}},
            {"hours", {hour("01-01T08", {0.5, -0.25}), hour("01-01T09", {1, 0})}}};
}

ListedDaylight read(const Json& json, int pages = 1)
{
    return daylight_of(JsonView(kFile, json), pages);
}

TEST(DaylightList, HoldsMapsAndHours)
{
    Json json = document();
    json["hours"].push_back(hour("02-29T00", {0, 1}));
    json["hours"].push_back(hour("12-31T23", {0, 1}));
    const ListedDaylight daylight = read(json);
    EXPECT_EQ(daylight.place, "Made");
    EXPECT_EQ(daylight.latitude, 47.5);
    EXPECT_EQ(daylight.longitude, -19.0);
    EXPECT_EQ(daylight.error, 0.0085);
    EXPECT_EQ(daylight.maps, (std::vector<std::string>{"daylight-a", "daylight-b"}));
    ASSERT_EQ(daylight.hours.size(), 4u);
    EXPECT_EQ(daylight.hours[0].index, 8);
    EXPECT_EQ(daylight.hours[2].index, (31 + 28) * 24);
    EXPECT_EQ(daylight.hours[3].index, 366 * 24 - 1) << "days are those of a leap year";
    EXPECT_EQ(daylight.hours[0].sun, glm::dvec3(0.6, 0.8, 0.0));
    EXPECT_EQ(daylight.hours[0].lux, 1234.5);
    EXPECT_EQ(daylight.hours[0].mean, 210.0);
    EXPECT_EQ(daylight.hours[0].weights, (std::vector<float>{0.5f, -0.25f}));
}

TEST(DaylightList, NamesTheFirstPageOfMapsWithSeveral)
{
    Json json = document();
    json["maps"] = {map("06-21T12", "a-0.exr"), map("06-21T12", "b-0.exr")};
    EXPECT_EQ(read(json, 2).maps[1], "b");
    EXPECT_THROW(read(document(), 2), Error);
}

TEST(DaylightList, RefusesWhatIsWrongInASentenceThatNamesIt)
{
    const auto expect = [](const char* pointer, const Json& value, const std::string& part) {
        Json json = document();
        json[Json::json_pointer(pointer)] = value;
        const std::string said = test::input_error_of([&] { read(json); });
        EXPECT_NE(said.find(kFile + ": " + pointer), said.npos) << said;
        EXPECT_NE(said.find(part), said.npos) << said;
    };
    expect("/place", 7, "object");
    expect("/place/name", 7, "string");
    expect("/place/latitude", 91, "must lie in");
    expect("/place/longitude", "east", "number");
    expect("/error", -1, "must lie in");
    expect("/maps", Json::array(), "has 0 maps, but must have 1 to 48");
    expect("/maps", Json(49, map("06-21T12", "a.exr")), "has 49 maps, but must have 1 to 48");
    expect("/maps/1/map", "../a.exr", "in the folder of the bake");
    expect("/maps/1/map", "/a.exr", "in the folder of the bake");
    expect("/maps/1/map", "a.png", "must end with .exr");
    expect("/maps/0/hour", "noon", "must be an hour of the year");
    expect("/hours", Json::array(), "has no hour");
    expect("/hours", 7, "array");
    for (const char* wrong : {"6-21T12", "13-01T12", "00-01T12", "02-30T12", "06-00T12", "06-21T24",
                              "06-21 12", "06-21T1x", "06-21T12:00", ""})
        expect("/hours/0/hour", wrong, "must be an hour of the year, such as 06-21T15");
    expect("/hours/1/hour", "01-01T08", "must be later than the hour before it");
    expect("/hours/1/hour", "01-01T07", "must be later than the hour before it");
    expect("/hours/0/sun", {1, 0}, "must be [x, y, z]");
    expect("/hours/0/sun", {0.5, 0.5, 0}, "must be of length 1");
    expect("/hours/0/sun/1", 7, "must lie in");
    expect("/hours/0/lux", -1, "must lie in");
    expect("/hours/0/mean", "much", "number");
    expect("/hours/0/weights", {1}, "has 1 weights, but must have one for each of 2 maps");
    expect("/hours/0/weights/1", "half", "number");
    Json json = document();
    json.erase("hours");
    EXPECT_NE(test::input_error_of([&] { read(json); }).find("hours"), std::string::npos);
}

}  // namespace
}  // namespace lumel
