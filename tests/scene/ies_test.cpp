// IES LM-63 files: their light, and what is refused.

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "../support/input_error.h"
#include "../support/source_folder.h"
#include "gltf_builder.h"
#include "scene/load/ies.h"

using namespace lumel;
using namespace lumel::test;

namespace {

const std::string kFiles = support::data_path("ies/synthetic/");

Photometry read(const std::string& text)
{
    return read_ies(Bytes(text.begin(), text.end()), "lamp.ies", "lamp");
}

/// The message that reading must end with.
std::string error_of_text(const std::string& text)
{
    return input_error_of([&] { read(text); });
}

/// Numbers of a file with one horizontal angle and candela 100, 70, 0 at 0, 45 and 90 degrees.
std::string lamp(const std::string& first_line = "IESNA:LM-63-2002",
                 const std::string& factors = "1.0 1.0 10", const std::string& multiplier = "1")
{
    return first_line + "\n[TEST] none\nTILT=NONE\n1 -1 " + multiplier + " 3 1 1 2 0 0 0\n" +
           factors + "\n0 45 90\n0\n100 70 0\n";
}

/// Horizontal angles in full, with candela that are the same for each vertical angle.
std::string around(const std::string& angles, const std::vector<int>& candela)
{
    std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 " + std::to_string(candela.size()) +
                       " 1 2 0 0 0 1 1 10\n0 180\n" + angles + "\n";
    for (const int value : candela)
        text += std::to_string(value) + " " + std::to_string(value) + "\n";
    return text;
}

float candela(const Photometry& profile, int polar_degrees, int azimuth_degrees)
{
    const int column = azimuth_degrees * Photometry::kAzimuthSteps / 360;
    const int row = polar_degrees * Photometry::kPolarSteps / 180;
    return profile.candela[std::size_t(column * (Photometry::kPolarSteps + 1) + row)];
}

/// Luminous flux [lm] through the sphere.
double flux(const Photometry& profile)
{
    Scene scene;
    scene.profiles.push_back(profile);
    PunctualLight light;
    light.profile = 0;
    constexpr int kRows = 720, kColumns = 144;
    double sum = 0.0;
    for (int row = 0; row < kRows; ++row) {
        const double step = std::numbers::pi / kRows, polar = (row + 0.5) * step;
        const double angle =
            (std::cos(row * step) - std::cos((row + 1) * step)) * 2.0 * std::numbers::pi / kColumns;
        for (int column = 0; column < kColumns; ++column) {
            const double azimuth = (column + 0.5) * 2.0 * std::numbers::pi / kColumns;
            const glm::vec3 direction(std::sin(polar) * std::cos(azimuth),
                                      std::sin(polar) * std::sin(azimuth), -std::cos(polar));
            sum += angle * double(intensity_towards(scene, light, direction).x);
        }
    }
    return sum;
}

}  // namespace

TEST(Ies, FilesOfEveryGenerationHaveTheirFlux)
{
    if (!std::filesystem::exists(kFiles))
        GTEST_SKIP() << "the test data is absent";
    // 100, 70 and 0 cd at 0, 45 and 90 degrees, linear between: 2π ∫ I sin θ dθ. With
    // ∫ (a + b θ) sin θ dθ = [b sin θ − (a + b θ) cos θ].
    const double quarter = std::numbers::pi / 4.0, first = -30.0 / quarter,
                 second = -70.0 / quarter;
    const double small =
        2.0 * std::numbers::pi * ((first - second) * std::sin(quarter) + second + 100.0);
    const std::pair<const char*, double> expected[] = {
        {"isotropic_1000lm", 1000.0},
        {"lambertian_down_1000lm", 999.84},
        {"narrow_cos20_500cd", 150.08},
        {"quadrant_symmetric_0_90", 1413.50},
        {"asymmetric_0_360_updown", 835.99},
        {"lm63_1986_no_header", small},
        {"lm63_1991", small},
        {"lm63_1995_tilt_include", small},
        {"lm63_2019", small},
        {"one_value_per_line", small},
        {"feet_units_ballast_multiplier", 0.9 * small},
    };
    for (const auto& [name, lumens] : expected) {
        const std::string path = kFiles + name + ".ies";
        EXPECT_NEAR(flux(read_ies(read_file(path, path), path, name)), lumens, 0.005 * lumens)
            << name;
    }
}

TEST(Ies, MultiplierAndBallastScaleTheCandela)
{
    EXPECT_FLOAT_EQ(candela(read(lamp()), 0, 0), 100.0f);
    EXPECT_FLOAT_EQ(candela(read(lamp("IESNA:LM-63-2002", "0.5 1 10", "3")), 0, 0), 150.0f);
}

TEST(Ies, TheSecondFactorCountsInTheOldEditionsOnly)
{
    EXPECT_FLOAT_EQ(candela(read(lamp("a lamp", "1 0.5 10")), 0, 0), 50.0f);
    EXPECT_FLOAT_EQ(candela(read(lamp("IESNA91", "1 0.5 10")), 0, 0), 50.0f);
    EXPECT_FLOAT_EQ(candela(read(lamp("IESNA:LM-63-1995", "1 0.5 10")), 0, 0), 100.0f);
    EXPECT_FLOAT_EQ(candela(read(lamp("IES:LM-63-2019", "1 1.1 10")), 0, 0), 100.0f);
}

TEST(Ies, AnglesAboveTheTableAreDark)
{
    const Photometry profile = read(lamp());
    EXPECT_FLOAT_EQ(candela(profile, 45, 0), 70.0f);
    EXPECT_FLOAT_EQ(candela(profile, 30, 120), 80.0f);
    EXPECT_EQ(candela(profile, 91, 0), 0.0f);
    EXPECT_EQ(candela(profile, 180, 0), 0.0f);
}

TEST(Ies, WhatIsSymmetricIsReflected)
{
    const Photometry quadrant = read(around("0 45 90", {1, 2, 5}));
    for (const int azimuth : {45, 135, 225, 315})
        EXPECT_FLOAT_EQ(candela(quadrant, 60, azimuth), 2.0f) << azimuth;
    EXPECT_FLOAT_EQ(candela(quadrant, 60, 180), 1.0f);
    EXPECT_FLOAT_EQ(candela(quadrant, 60, 270), 5.0f);

    const Photometry bilateral = read(around("0 90 180", {1, 2, 5}));
    EXPECT_FLOAT_EQ(candela(bilateral, 60, 180), 5.0f);
    EXPECT_FLOAT_EQ(candela(bilateral, 60, 90), 2.0f);
    EXPECT_FLOAT_EQ(candela(bilateral, 60, 270), 2.0f);
    EXPECT_FLOAT_EQ(candela(bilateral, 60, 315), 1.5f);

    const Photometry sideways = read(around("90 180 270", {1, 2, 5}));
    EXPECT_FLOAT_EQ(candela(sideways, 60, 180), 2.0f);
    EXPECT_FLOAT_EQ(candela(sideways, 60, 0), 2.0f);
    EXPECT_FLOAT_EQ(candela(sideways, 60, 90), 1.0f);
    EXPECT_FLOAT_EQ(candela(sideways, 60, 315), 3.5f);

    const Photometry whole = read(around("0 120 240 360", {1, 2, 5, 1}));
    EXPECT_FLOAT_EQ(candela(whole, 60, 240), 5.0f);
    EXPECT_FLOAT_EQ(candela(whole, 60, 300), 3.0f);
}

TEST(Ies, LineEndsAndCommasDoNotMatter)
{
    std::string text = lamp();
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\r\n");
    EXPECT_EQ(read(text).candela, read(lamp()).candela);
    for (char& c : text)
        c = c == '\n' ? ' ' : c;  // old Macintosh
    EXPECT_EQ(read(text).candela, read(lamp()).candela);
    std::string commas = lamp();
    commas.replace(commas.find("100 70 0"), 8, "100,+70, 0");
    EXPECT_EQ(read(commas).candela, read(lamp()).candela);
}

TEST(Ies, MistakesAreNamedWithTheirLine)
{
    const auto with = [](const std::string& part, const std::string& other) {
        std::string text = lamp();
        return error_of_text(text.replace(text.find(part), part.size(), other));
    };
    EXPECT_TRUE(contains(with("100 70 0", "100 7o 0"), "lamp.ies: line 8: \"7o\" is not a number"));
    EXPECT_TRUE(contains(with("100 70 0", "100 70"), "ends before its candela"));
    EXPECT_TRUE(contains(with("100 70 0", "100 70 0 9"), "line 8: \"9\" follows"));
    EXPECT_TRUE(contains(with("100 70 0", "100 -70 0"), "line 8: the candela is below 0"));
    EXPECT_TRUE(contains(with("100 70 0", "100 1e999 0"), "is not a number"));
    EXPECT_TRUE(contains(with("0 45 90", "0 95 90"), "line 6: the vertical angles must grow"));
    EXPECT_TRUE(contains(with("0 45 90", "-90 45 90"), "vertical angles must be"));
    EXPECT_TRUE(contains(with("90\n0\n", "90\n5\n"), "horizontal angles must go"));
    EXPECT_TRUE(contains(with("3 1 1 2", "3 1 2 2"), "line 4: the photometry is of type B"));
    EXPECT_TRUE(contains(with("3 1 1 2", "3 1 3 2"), "of type A"));
    EXPECT_TRUE(contains(with("3 1 1 2", "3 1 7 2"), "photometric type"));
    EXPECT_TRUE(contains(with("3 1 1 2", "2.5 1 1 2"), "line 4: the number of vertical angles"));
    EXPECT_TRUE(contains(with("3 1 1 2", "1e9 1 1 2"), "number of vertical angles"));
    EXPECT_TRUE(contains(with("TILT=NONE\n", ""), "without a line TILT="));
    EXPECT_TRUE(contains(error_of_text("GIF89a"), "not an IES LM-63"));
    EXPECT_TRUE(contains(error_of_text(""), "not an IES LM-63"));
}
