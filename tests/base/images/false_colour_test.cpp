// Illuminance as colours, with a legend.

#include "base/images/false_colour.h"

#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "../../support/source_folder.h"
#include "base/images/digits.h"

using namespace lumel;

namespace {

glm::vec3 pixel(const Image& image, int x, int y)
{
    return {image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]};
}

/// A text in black on white, row by row.
std::string drawn(const std::string& text)
{
    const glm::ivec2 size = text_size(text, 1);
    Image image(size.x, size.y, 3);
    image.values.assign(image.values.size(), 1.0f);
    draw_text(image, {0, 0}, text, 1, glm::vec3(0.0f));
    std::string rows;
    for (int y = 0; y < image.height; ++y, rows += '\n')
        for (int x = 0; x < image.width; ++x)
            rows += image.at(x, y)[0] < 0.5f ? '#' : '.';
    return rows;
}

}  // namespace

TEST(FalseColour, HasTheColoursOfPages)
{
    std::ifstream file(support::source_path("src/results/page/viewer/colours.js"));
    std::stringstream text;
    text << file.rdbuf();
    const std::string script = text.str();
    const std::size_t from = script.find("const anchors");
    const std::string anchors = script.substr(from, script.find(';', from) - from);
    const std::regex triple(R"(\[(\d+), (\d+), (\d+)\])");
    std::vector<glm::vec3> colours;
    for (std::sregex_iterator it(anchors.begin(), anchors.end(), triple), end; it != end; ++it)
        colours.emplace_back(std::stof((*it)[1]), std::stof((*it)[2]), std::stof((*it)[3]));
    ASSERT_EQ(colours.size(), 7u);
    for (std::size_t i = 0; i < colours.size(); ++i)
        EXPECT_LT(glm::distance(255.0f * scale_color(double(i) / 6.0), colours[i]), 1e-3f) << i;
    EXPECT_EQ(scale_color(-1.0), scale_color(0.0));
    EXPECT_EQ(scale_color(2.0), scale_color(1.0));
}

TEST(FalseColour, TheScaleHasNumbersOfOneTwoAndFiveOnly)
{
    const std::vector<float> lux = {-1.0f, 0.0f, 3.0f, 120.0f, 480.0f};
    const LuxScale scale = scale_for(lux);
    EXPECT_NEAR(scale.low, 2.5, 1e-6);
    EXPECT_NEAR(scale.high, 200.0, 1e-6);
    const std::vector<double> ticks = scale.ticks();
    const std::vector<double> expected = {5.0, 10.0, 20.0, 50.0, 100.0, 200.0};
    ASSERT_EQ(ticks.size(), expected.size());
    for (std::size_t i = 0; i < ticks.size(); ++i)
        EXPECT_NEAR(ticks[i], expected[i], 1e-6);
    EXPECT_NEAR(scale.place_of(scale.lux_at(0.3)), 0.3, 1e-9);
    EXPECT_EQ(tick_text(0.05), "0.05");
    EXPECT_EQ(tick_text(0.2), "0.2");
    EXPECT_EQ(tick_text(1.0), "1");
    EXPECT_EQ(tick_text(20000.0), "20000");
}

TEST(FalseColour, DigitsAreDrawnAndAllDiffer)
{
    EXPECT_EQ(drawn("7"), "#####\n....#\n...#.\n..#..\n.#...\n.#...\n.#...\n");
    std::set<std::string> shapes;
    for (char digit = '0'; digit <= '9'; ++digit)
        shapes.insert(drawn(std::string(1, digit)));
    EXPECT_EQ(shapes.size(), 10u);
}

TEST(FalseColour, ThePictureShowsTheColourOfEachValueAndALegend)
{
    Image lux(300, 300, 1);
    for (int y = 0; y < lux.height; ++y)
        for (int x = 0; x < lux.width; ++x)
            lux.at(x, y)[0] = x < 100 ? -1.0f : x < 200 ? 10.0f : 100.0f;
    const Image picture = false_colour(lux, {.low = 10.0, .high = 100.0});
    EXPECT_GT(picture.width, lux.width);
    EXPECT_EQ(pixel(picture, 50, 50).r, pixel(picture, 50, 50).g);
    EXPECT_EQ(pixel(picture, 150, 50), scale_color(0.0));
    EXPECT_EQ(pixel(picture, 250, 50), scale_color(1.0));
    // The legend has both ends of the scale, and dark ink right of it for the numbers.
    bool low = false, high = false;
    int ink = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = lux.width; x < picture.width; ++x) {
            const glm::vec3 color = pixel(picture, x, y);
            low = low || glm::distance(color, scale_color(0.0)) < 0.01f;
            high = high || glm::distance(color, scale_color(1.0)) < 0.01f;
            ink += color.r < 0.15f && color.r == color.g && color.g == color.b;
        }
    EXPECT_TRUE(low && high);
    EXPECT_GT(ink, 200);
}
