// Previews of five bakes against stored pictures, which ./test --golden renews.

#include <array>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "../cli/program.h"
#include "../support/source_folder.h"
#include "perceived.h"

namespace lumel::test {
namespace {

constexpr const char *kSize = "128", *kWidth = "256";

/// Mean and 99th percentile of the difference. Another seed gives 0.09 to 0.38 and 0.7 to 2.0: the
/// noise of an error of 1 to 2 %. A picture that is 5 % brighter gives a mean of 0.66 to 1.4, a sun
/// 5 degrees aside 0.5 to 0.6 and up to 4.6.
constexpr double kMostMean = 0.55, kMostHigh = 3.0;

struct Golden {
    const char* name;
    std::vector<std::string> options;
};

const std::array kPictures = {
    Golden{"cornell-box", {"--error", "1"}},
    Golden{"room", {}},
    Golden{"city", {"--sun", "110,35"}},
    Golden{"two-rooms-window", {"--sun", "265,35", "--error", "1"}},
    Golden{"three-balls", {"--sky", "500,500,500", "--sun", "120,40"}},
};

class Previews : public testing::TestWithParam<Golden> {};

INSTANTIATE_TEST_SUITE_P(Of, Previews, testing::ValuesIn(kPictures), [](const auto& test) {
    std::string name = test.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

void write_picture(const std::string& path, const Picture& picture)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(picture.width);
    image.height = png_uint_32(picture.height);
    image.format = PNG_FORMAT_RGB;
    EXPECT_TRUE(png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr))
        << path;
}

/// White: a difference of 10 and more.
Picture picture_of(const std::vector<float>& difference, const Picture& like)
{
    Picture picture{like.width, like.height, {}};
    for (const float one : difference)
        picture.rgb.insert(picture.rgb.end(), 3,
                           static_cast<unsigned char>(std::min(25.5f * one, 255.0f)));
    return picture;
}

TEST_P(Previews, LookAsTheyDid)
{
    const auto& [name, options] = GetParam();
    const Workplace place;
    const std::string scene = fmt::format("{}.gltf", name);
    std::vector<std::string> bake = {
        "bake", own_scene(scene), place.path("out"), "--size", kSize, "--preview-width", kWidth,
        "-q"};
    bake.insert(bake.end(), options.begin(), options.end());
    const Outcome outcome = run_lumel(bake);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string golden = support::source_path(fmt::format("tests/golden/{}.png", name)),
                      preview = place.path("out/preview.png");
    if (std::getenv("LUMEL_GOLDEN") != nullptr) {
        std::filesystem::copy_file(preview, golden,
                                   std::filesystem::copy_options::overwrite_existing);
        GTEST_SKIP() << golden << " is renewed: look at it";
    }
    const Picture wanted = read_picture(golden), found = read_picture(preview);
    const std::vector<float> difference = perceived_difference(wanted, found);
    const Perceived apart = summary_of(difference);
    std::printf("%s: %.2f, 1 %% above %.2f\n", name, apart.mean, apart.high);
    EXPECT_LE(apart.mean, kMostMean);
    EXPECT_LE(apart.high, kMostHigh);
    if (!HasFailure())
        return;
    const auto written = [&](const char* what, const Picture& picture) {
        const std::string path = std::filesystem::absolute(fmt::format("{}-{}.png", name, what));
        write_picture(path, picture);
        return path;
    };
    ADD_FAILURE() << "see " << written("wanted", wanted) << ", " << written("found", found)
                  << " and " << written("difference", picture_of(difference, wanted));
}

}  // namespace
}  // namespace lumel::test
