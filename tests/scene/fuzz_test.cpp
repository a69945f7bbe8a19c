// Damaged files end in an Error or are read; nothing else may happen.

#include <random>

#include <gtest/gtest.h>

#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace {

/// A file that touches most of the reader: texture, indices, sparse, light, camera, hierarchy.
Bytes rich_file()
{
    GltfBuilder builder = one_triangle();
    builder.add_accessor<std::uint16_t>({0, 1, 2}, "SCALAR", 5123, 3);
    builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", 5126, 3);
    builder.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 5126, 3);
    builder.replace_sparsely(2, glm::vec3(0, 7, 0));
    const Bytes png = make_png(2, 1, {0, 0, 0, 255, 255, 255, 255, 255});
    const int view = builder.add_view(png.data(), png.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    builder.push("samplers", {{"wrapS", 33071}});
    builder.push("textures", {{"source", 0}, {"sampler", 0}});
    builder.push("materials", {{"emissiveFactor", {1, 1, 1}},
                               {"emissiveTexture", {{"index", 0}}},
                               {"alphaMode", "MASK"}});
    builder.json["meshes"][0]["primitives"][0] = {
        {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 2}, {"NORMAL", 3}}},
        {"indices", 1},
        {"material", 0}};
    builder.push("cameras",
                 {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "point"}, {"intensity", 3}}});
    builder.push("nodes", {{"children", {0}},
                           {"camera", 0},
                           {"rotation", {0, 0, 0, 1}},
                           {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.json["scenes"][0]["nodes"] = {1};
    return builder.glb();
}

/// Reads the bytes; anything but success or Error{input} escapes and fails the test.
bool is_read(const TempFolder& folder, const Bytes& bytes)
{
    try {
        const Scene scene = read_gltf(folder.write("fuzz.glb", bytes));
        for (const Instance& instance : scene.instances)
            for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
                for (std::uint32_t index : primitive.indices)
                    EXPECT_LT(index, primitive.positions.size());
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return false;
    }
}

}  // namespace

TEST(Fuzz, TheUndamagedFileIsRead)
{
    const TempFolder folder;
    EXPECT_TRUE(is_read(folder, rich_file()));
}

TEST(Fuzz, EveryTruncationIsAnError)
{
    const TempFolder folder;
    const Bytes file = rich_file();
    for (std::size_t size = 0; size < file.size(); ++size)
        EXPECT_FALSE(is_read(folder, Bytes(file.begin(), file.begin() + std::ptrdiff_t(size))));
}

TEST(Fuzz, FlippedBytesAreHarmless)
{
    const TempFolder folder;
    const Bytes file = rich_file();
    for (std::size_t i = 0; i < file.size(); ++i) {
        Bytes damaged = file;
        damaged[i] ^= 0x01;
        is_read(folder, damaged);
        damaged[i] ^= 0x81;
        is_read(folder, damaged);
    }
}

TEST(Fuzz, RandomDamageIsHarmless)
{
    const TempFolder folder;
    const Bytes file = rich_file();
    std::mt19937 random(7);
    for (int run = 0; run < 3000; ++run) {
        Bytes damaged = file;
        const auto changes = 1 + random() % 6;
        for (std::uint32_t change = 0; change < changes; ++change) {
            const std::size_t at = random() % damaged.size();
            // Digits keep the JSON parsable, so that the damage reaches deeper.
            damaged[at] = damaged[at] >= '0' && damaged[at] <= '9'
                              ? std::uint8_t('0' + random() % 10)
                              : std::uint8_t(random());
        }
        is_read(folder, damaged);
    }
}

TEST(Fuzz, ChangedNumbersAreHarmless)
{
    const TempFolder folder;
    const Bytes file = rich_file();
    std::mt19937 random(11);
    std::vector<std::size_t> digits;
    const std::size_t json_size = file[12] | std::size_t(file[13]) << 8;
    for (std::size_t i = 20; i < 20 + json_size; ++i)
        if (file[i] >= '0' && file[i] <= '9')
            digits.push_back(i);
    for (std::size_t digit : digits)
        for (char replacement : std::string("0123456789-.e\""))
            if (random() % 2 == 0) {
                Bytes damaged = file;
                damaged[digit] = std::uint8_t(replacement);
                is_read(folder, damaged);
            }
}
