// Entries in fewer bits.

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "bench/papers/matrix_blocks.h"
#include "bench/papers/matrix_codes_product.h"
#include "tests/solve/matrix/products.h"
#include "tests/solve/matrix/random_matrix.h"

namespace lumel::bench {
namespace {

constexpr std::uint32_t kSize = 203;  // no multiple of anything

TEST(Bc1OfCodes, ABlockOfOneStoredColorIsExact)
{
    for (const std::array<float, 3> color :
         {std::array{0.0f, 0.0f, 0.0f}, std::array{255.0f, 255.0f, 255.0f},
          std::array{132.0f, 65.0f, 24.0f}}) {
        ColorBlock block;
        block.fill(color);
        for (const auto& texel : decode_bc1(encode_bc1(block)))
            for (int c = 0; c < 3; ++c)
                EXPECT_FLOAT_EQ(texel[c], color[c]);
    }
}

// Mixtures 2 : 1 of two stored values lie closer together than those do.
TEST(Bc1OfCodes, ABlockOfAnyOneColorIsWithinTwoSteps)
{
    for (int value = 0; value < 256; ++value) {
        ColorBlock block;
        block.fill({float(value), float(255 - value), float(value)});
        for (const auto& texel : decode_bc1(encode_bc1(block)))
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(texel[c], block[0][c], 2.0f);
    }
}

// Each endpoint is rounded to 5 bits at worst: half a step of 255 / 31.
TEST(Bc1OfCodes, ABlockOfTwoColorsIsWithinHalfAStepOfItsEndpoints)
{
    const std::array<float, 3> dark = {10.0f, 40.0f, 90.0f}, light = {200.0f, 220.0f, 140.0f};
    ColorBlock block;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        block[i] = i % 3 == 0 ? dark : light;
    const ColorBlock decoded = decode_bc1(encode_bc1(block));
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(decoded[i][c], block[i][c], 0.5f * 255.0f / 31.0f + 0.51f);
}

/// Codes of entries that spread over factors of up to e^3, as in a row of a matrix.
ColorBlock random_codes(std::mt19937& random)
{
    std::normal_distribution<float> log_of_entry(0.0f, 1.0f), of_channel(0.0f, 0.2f);
    ColorBlock block;
    for (auto& texel : block) {
        const float shared = 200.0f + 10.0f * log_of_entry(random);
        for (float& code : texel)
            code = std::clamp(std::round(shared + 10.0f * of_channel(random)), 0.0f, 255.0f);
    }
    return block;
}

constexpr float kOffset = 25.0f;  // the paper's

double entry_of(float code)
{
    return code < 0.5f ? 0.0 : std::exp((double(code) / 255.0 - 1.0) * double(kOffset));
}

/// Σ (v' − v)² of the entries that codes stand for.
double squared_error_of_entries(const ColorBlock& codes, const BlockWords& words)
{
    const ColorBlock decoded = decode_bc1(words);
    double sum = 0.0;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum += std::pow(entry_of(decoded[i][c]) - entry_of(codes[i][c]), 2);
    return sum;
}

// Blocks of logarithms are made for what these stand for: nearer than blocks made for the codes,
// for every one of them, and by two fifths in all.
TEST(Bc1OfCodes, IsFartherFromTheEntriesThanABlockMadeForThem)
{
    std::mt19937 random(1);
    const Bc1Encoder encoder(kOffset, {1.0f, 1.0f, 1.0f});
    double ours = 0.0, of_codes = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
        const ColorBlock block = random_codes(random);
        const double error = squared_error_of_entries(block, encoder.encode(block));
        const double other = squared_error_of_entries(block, encode_bc1(block));
        EXPECT_LE(error, other * (1.0 + 1e-6));
        ours += error;
        of_codes += other;
    }
    EXPECT_LT(ours, 0.6 * of_codes);
}

TEST(Bc4, ABlockOfTwoValuesIsExact)
{
    GrayBlock block;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        block[i] = i % 5 == 0 ? 17.0f : 203.0f;
    EXPECT_EQ(decode_bc4(encode_bc4(block)), block);
}

// The others keep steps of a fifth of their range.
TEST(Bc4, AZeroAmongLargeValuesStaysZero)
{
    GrayBlock block;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        block[i] = i == 7 ? 0.0f : 200.0f + float(i);
    const GrayBlock decoded = decode_bc4(encode_bc4(block));
    EXPECT_EQ(decoded[7], 0.0f);
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        EXPECT_NEAR(decoded[i], block[i], 15.0f / 10.0f + 0.5f);
}

TEST(CodedMatrix, OfFloatsIsTheMatrix)
{
    const ColorMatrix matrix = shuffled_kernel(50, 3);
    EXPECT_EQ(squared_difference(decode(encode(matrix, {.code = Code::float32})), matrix), 0.0);
}

// Half a unit in the last of 11 digits.
TEST(CodedMatrix, OfHalvesIsWithinTheirRounding)
{
    const ColorMatrix matrix = shuffled_kernel(50, 3);
    const ColorMatrix decoded = decode(encode(matrix, {.code = Code::float16}));
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < matrix.channel[c].values.size(); ++i)
            EXPECT_NEAR(decoded.channel[c].values[i], matrix.channel[c].values[i],
                        matrix.channel[c].values[i] / 2047.0f);
}

// Half of a step in the logarithm: e^(offset / 510).
TEST(CodedMatrix, OfLogarithmsIsWithinHalfAStepAndItsLargestAreExact)
{
    const ColorMatrix matrix = shuffled_kernel(50, 4);
    for (const bool mend : {false, true}) {
        const CodingOptions options{.code = Code::log8, .exact_share = 0.1f, .mend = mend};
        const CodedMatrix coded = encode(matrix, options);
        const ColorMatrix decoded = decode(coded);
        for (int c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < matrix.channel[c].values.size(); ++i) {
                const float value = matrix.channel[c].values[i];
                EXPECT_NEAR(decoded.channel[c].values[i], value,
                            value * (std::exp(25.0f / 510.0f) - 1.0f) * 1.001f);
            }
            for (std::uint32_t entry = 0; entry < coded.decoding.exact.value[c].size(); ++entry) {
                const std::uint32_t row = entry / 5, column = coded.decoding.exact.column[c][entry];
                EXPECT_FLOAT_EQ(decoded.channel[c].at(row, column),
                                matrix.channel[c].at(row, column));
            }
        }
    }
}

TEST(CodedMatrix, OfBlocksComesBackInTheCallersOrderAndIsCloserWhenReordered)
{
    const ColorMatrix matrix = shuffled_kernel(90, 5);
    for (const Code code : {Code::bc1_of_codes, Code::bc4}) {
        const auto error = [&](Reordering how) {
            return squared_difference(decode(encode(matrix, {.code = code, .reordering = how})),
                                      matrix);
        };
        EXPECT_LT(error(Reordering::rows_and_columns), error(Reordering::none));
    }
}

// 8 bytes for 16 texels of three channels, or of one.
TEST(CodedMatrix, TakesTheBytesOfItsBlocks)
{
    const ColorMatrix matrix = shuffled_kernel(64, 6);
    const CodingOptions bare{.exact_share = 0.0f, .reordering = Reordering::none};
    const auto bytes = [&](Code code) {
        CodingOptions options = bare;
        options.code = code;
        return encode(matrix, options).bytes();
    };
    EXPECT_EQ(bytes(Code::float32), 64u * 64u * 12u);
    EXPECT_EQ(bytes(Code::float16), 64u * 64u * 6u);
    EXPECT_EQ(bytes(Code::log8), 64u * 64u * 3u);
    EXPECT_EQ(bytes(Code::bc4), 64u * 64u * 3u / 2u);
    EXPECT_EQ(bytes(Code::bc1_of_codes), 64u * 64u / 2u);
}

TEST(CodedMatrix, OnTheGpuIsTheStoredMatrixForEveryCode)
{
    const gpu::Device device;
    const ColorMatrix matrix = shuffled_kernel(kSize, 1);
    for (const Code code : {Code::float32, Code::float16, Code::log8, Code::bc1, Code::bc4})
        for (const std::uint32_t states : {1u, 6u}) {
            const CodedMatrix coded = encode(matrix, {.code = code});
            const std::vector<glm::vec3> x = random_light(std::size_t(states) * kSize);
            SCOPED_TRACE(int(code));
            expect_products(on_gpu(device, MultiplyCoded(device, coded, states), x, states),
                            decode(coded), x, kPowerRounding);
        }
    EXPECT_EQ(device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel::bench
