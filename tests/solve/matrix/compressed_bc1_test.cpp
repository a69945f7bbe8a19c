// The paper's form: logarithms in BC1 blocks, reordered, the largest entries apart.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "solve/matrix/compressed_bc1.h"
#include "tests/solve/matrix/random_matrix.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel {
namespace {

constexpr float kOffset = 25.0f;  // the paper's

const Bc1Encoder& encoder()
{
    static const Bc1Encoder instance(kOffset, {1.0f, 1.0f, 1.0f});
    return instance;
}

TEST(Bc1, ABlockOfOneStoredColorIsExact)
{
    for (const std::array<float, 3> color :
         {std::array{0.0f, 0.0f, 0.0f}, std::array{255.0f, 255.0f, 255.0f},
          std::array{132.0f, 130.0f, 140.0f}}) {
        ColorBlock block;
        block.fill(color);
        for (const auto& texel : decode_bc1(encoder().encode(block)))
            for (int c = 0; c < 3; ++c)
                EXPECT_FLOAT_EQ(texel[c], color[c]);
    }
}

// Mixtures 2 : 1 of two stored values lie closer together than those do.
TEST(Bc1, ABlockOfAnyOneGreyIsWithinTwoSteps)
{
    for (int value = 0; value < 256; ++value) {
        ColorBlock block;
        block.fill({float(value), float(value), float(value)});
        for (const auto& texel : decode_bc1(encoder().encode(block)))
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(texel[c], block[0][c], 2.0f);
    }
}

// Each end is rounded to 5 bits at worst: half a step of 255 / 31.
TEST(Bc1, ABlockOfTwoColorsIsWithinHalfAStepOfThem)
{
    const std::array<float, 3> dark = {170.0f, 180.0f, 190.0f}, light = {200.0f, 220.0f, 210.0f};
    ColorBlock block;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        block[i] = i % 3 == 0 ? dark : light;
    const ColorBlock decoded = decode_bc1(encoder().encode(block));
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(decoded[i][c], block[i][c], 0.5f * 255.0f / 31.0f + 0.51f);
}

// DXT1 has a mode of three colours and black; what is kept exactly leaves a 0.
TEST(Bc1, ZerosAmongLargeEntriesStayZeroAndCostTheOthersNothing)
{
    ColorBlock block;
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        block[i] = i % 4 == 1 ? std::array{0.0f, 0.0f, 0.0f} : std::array{198.0f, 199.0f, 198.0f};
    const ColorBlock decoded = decode_bc1(encoder().encode(block));
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(decoded[i][c], block[i][c], block[i][c] > 0.0f ? 4.2f : 0.0f);
}

// Whatever a channel that does not count holds, the others are as if it held what they do.
TEST(Bc1, ChannelsThatDoNotCountCostTheOthersNothing)
{
    constexpr std::array<float, 3> wanted = {132.0f, 130.0f, 140.0f};
    ColorBlock block;
    block.fill(wanted);
    FreeChannels free{};
    for (std::size_t i = 0; i < kBlockTexels; i += 3) {
        free[i] = std::uint8_t(1u << (i % 2));
        block[i][i % 2] = 250.0f;
    }
    const ColorBlock decoded = decode_bc1(encoder().encode(block, free));
    for (std::size_t i = 0; i < kBlockTexels; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            if ((free[i] >> c & 1u) == 0) {
                EXPECT_FLOAT_EQ(decoded[i][c], wanted[c]);
            }
        }
}

TEST(Reordering, IsAPermutationThatKeepsTheFirst)
{
    const ColorMatrix matrix = shuffled_kernel(37, 1);
    const std::vector<std::uint32_t> order = order_by_likeness(matrix.channel[0].values, 37, 37);
    EXPECT_EQ(order.front(), 0u);
    std::vector<std::uint32_t> sorted = order, all(37);
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(sorted, all);
}

TEST(Reordering, WalksFromLikeToLike)
{
    const std::vector<float> rows = {0, 0, 9, 9, 1, 1, 8, 8, 2, 2};
    EXPECT_EQ(order_by_likeness(rows, 5, 2), (std::vector<std::uint32_t>{0, 2, 4, 3, 1}));
}

/// Codes before and after reordering.
std::pair<LogImage, std::pair<LogImage, LogDecoding>> reorderings(const ColorMatrix& matrix,
                                                                  Reordering how)
{
    const LogOptions bare{.exact_share = 0.0f, .reordering = Reordering::none};
    LogOptions options = bare;
    options.reordering = how;
    return {take_logarithms(matrix, bare).first, take_logarithms(matrix, options)};
}

// [SF17 figure 6]. The diagonal of the kernel is 0: no patch sees itself.
TEST(Reordering, SwapsARowTogetherWithItsColumn)
{
    const ColorMatrix matrix = shuffled_kernel(38, 1);
    for (const Reordering how : {Reordering::rows, Reordering::rows_and_columns}) {
        const auto [before, after] = reorderings(matrix, how);
        const auto& [image, decoding] = after;
        ASSERT_EQ(decoding.order.size(), 38u);
        for (std::size_t i = 0; i < 38; ++i)
            for (std::size_t j = 0; j < 38; ++j) {
                const float code = image.channel[1][i * image.side + j];
                EXPECT_EQ(code == 0.0f, i == j);
                EXPECT_EQ(code,
                          before.channel[1][decoding.order[i] * image.side + decoding.order[j]]);
            }
    }
}

/// Codes of one channel, rows or columns: [n][n]
std::vector<float> lines(const LogImage& image, std::uint32_t n, bool columns)
{
    std::vector<float> codes;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            codes.push_back(image.channel[0][columns ? j * image.side + i : i * image.side + j]);
    return codes;
}

// "Then, we apply second reordering, but measure is computed for columns" [SF17]: swaps change
// neither the distances between columns nor which patch is first, so this order alone remains.
TEST(Reordering, ByRowsAndThenByColumnsIsThatByColumns)
{
    constexpr std::uint32_t n = 40;
    ColorMatrix matrix = shuffled_kernel(n, 3);
    matrix.channel[1] = matrix.channel[2] = matrix.channel[0];
    std::mt19937 random(4);
    std::uniform_real_distribution<float> factor(0.1f, 1.0f);
    for (std::size_t i = 0; i < n; ++i) {
        const float sent = factor(random);  // columns differ from rows
        for (std::size_t j = 0; j < n; ++j)
            for (SquareMatrix& channel : matrix.channel)
                channel.values[j * n + i] *= sent;
    }
    const LogImage before = reorderings(matrix, Reordering::none).first;
    const std::vector<std::uint32_t> first = order_by_likeness(lines(before, n, false), n, n);
    const LogImage swapped = reordered(before, first);
    std::vector<std::uint32_t> both;
    for (const std::uint32_t place : order_by_likeness(lines(swapped, n, true), n, n))
        both.push_back(first[place]);
    EXPECT_NE(both, first);
    EXPECT_EQ(reorderings(matrix, Reordering::rows_and_columns).second.second.order, both);
}

TEST(SparsePart, HoldsTheLargestOfEachRow)
{
    const ColorMatrix matrix = shuffled_kernel(50, 2);
    const SparsePart part = largest_entries(matrix, 0.1f);
    EXPECT_EQ(part.per_row, 5u);
    for (int c = 0; c < 3; ++c)
        for (std::uint32_t i = 0; i < 50; ++i) {
            std::vector<float> row(matrix.channel[c].values.begin() + 50 * i,
                                   matrix.channel[c].values.begin() + 50 * (i + 1));
            for (int k = 0; k < 5; ++k)
                EXPECT_EQ(part.value[c][i * 5 + k], row[part.column[c][i * 5 + k]]);
            std::vector<float> kept(part.value[c].begin() + 5 * i,
                                    part.value[c].begin() + 5 * (i + 1));
            std::sort(row.rbegin(), row.rend());
            std::sort(kept.rbegin(), kept.rend());
            row.resize(5);
            EXPECT_EQ(kept, row);
        }
}

// What is kept exactly makes up for what its place in a block lost.
TEST(Bc1Matrix, HoldsItsLargestEntriesExactly)
{
    const ColorMatrix matrix = shuffled_kernel(50, 4);
    for (const bool mend : {false, true}) {
        const Bc1Matrix compressed =
            compress_bc1(matrix, {.exact_share = 0.1f, .mend = mend, .spread = false});
        const SparsePart& exact = compressed.decoding.exact;
        const ColorMatrix decoded = decompress(compressed);
        ASSERT_EQ(exact.per_row, 5u);
        for (int c = 0; c < 3; ++c)
            for (std::uint32_t entry = 0; entry < exact.value[c].size(); ++entry) {
                const std::uint32_t row = entry / 5, column = exact.column[c][entry];
                const float wanted = matrix.channel[c].at(row, column);
                EXPECT_NEAR(decoded.channel[c].at(row, column), wanted,
                            mend ? 1e-6f * wanted : 0.3f * wanted);
            }
    }
}

TEST(Bc1Matrix, ComesBackInTheCallersOrderAndIsCloserWhenReordered)
{
    const ColorMatrix matrix = shuffled_kernel(90, 5);
    const auto error = [&](Reordering how) {
        return squared_difference(decompress(compress_bc1(matrix, {.reordering = how})), matrix);
    };
    EXPECT_LT(error(Reordering::rows_and_columns), error(Reordering::none));
}

// Light that is alike everywhere meets the sums of rows.
TEST(Bc1Matrix, ErrorsThatAreSpreadCancelInTheSumsOfRows)
{
    const TestRoom room = box_room(8);
    const ColorMatrix matrix = all_bounces(room);
    const std::vector<glm::vec3> white(matrix.size(), glm::vec3(1.0f));
    const auto error = [&](bool spread) {
        const std::vector<glm::vec3> wanted = multiply(matrix, white);
        const std::vector<glm::vec3> found =
            multiply(decompress(compress_bc1(matrix, {.spread = spread})), white);
        double square = 0.0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const glm::dvec3 off = glm::dvec3(found[i]) - glm::dvec3(wanted[i]);
            square += glm::dot(off, off);
        }
        return std::sqrt(square);
    };
    EXPECT_LT(error(true), 0.5 * error(false));
}

// 8 bytes for 16 texels of three channels.
TEST(Bc1Matrix, TakesTheBytesOfItsBlocks)
{
    const Bc1Matrix bare =
        compress_bc1(shuffled_kernel(64, 6), {.exact_share = 0.0f, .reordering = Reordering::none});
    EXPECT_EQ(bare.bytes(), 64u * 64u / 2u);
}

/// Direct light of a lamp of 1 cd on the walls of a box.
std::vector<glm::vec3> lamp_light(const TestRoom& room, const glm::vec3& lamp)
{
    std::vector<glm::vec3> light;
    for (std::size_t i = 0; i < room.elements.place.size(); ++i) {
        const glm::vec3 to = lamp - room.elements.place[i];
        const float square = glm::dot(to, to);
        light.emplace_back(std::max(glm::dot(to, room.elements.normal[i]), 0.0f) /
                           (square * std::sqrt(square)));
    }
    return light;
}

// "hardly differs" [SF17], which we take for 2 %.
TEST(Bc1Matrix, LightsARoomByLampsAsTheMatrixOfAllBounces)
{
    const TestRoom room = box_room(12);
    const ColorMatrix matrix = all_bounces(room);
    const ColorMatrix decoded = decompress(compress_bc1(matrix, {}));
    for (const glm::vec3& lamp : {glm::vec3(0.5f), glm::vec3(0.2f, 0.7f, 0.4f)}) {
        const std::vector<glm::vec3> light = lamp_light(room, lamp);
        const std::vector<glm::vec3> wanted = multiply(matrix, light);
        const std::vector<glm::vec3> found = multiply(decoded, light);
        double off = 0.0, all = 0.0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const glm::dvec3 truth(wanted[i]), difference = glm::dvec3(found[i]) - truth;
            off += glm::dot(difference, difference);
            all += glm::dot(truth, truth);
        }
        EXPECT_LT(std::sqrt(off / all), 0.02);
    }
}

// A few per cent, whichever patch is lit, where errors are not spread for light that is smooth.
TEST(Bc1Matrix, LightsARoomByEachPatchAsTheMatrixOfAllBounces)
{
    const TestRoom room = box_room(12);
    const ColorMatrix matrix = all_bounces(room);
    const ColorMatrix decoded =
        decompress(compress_bc1(matrix, {.offset = 12.0f, .spread = false}));
    EXPECT_LT(relative_error(decoded, matrix, room.elements), 0.03);
}

}  // namespace
}  // namespace lumel
