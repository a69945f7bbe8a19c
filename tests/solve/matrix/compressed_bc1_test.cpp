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
        const Bc1Matrix compressed = compress_bc1(matrix, {.exact_share = 0.1f, .mend = mend});
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

// 8 bytes for 16 texels of three channels.
TEST(Bc1Matrix, TakesTheBytesOfItsBlocks)
{
    const Bc1Matrix bare =
        compress_bc1(shuffled_kernel(64, 6), {.exact_share = 0.0f, .reordering = Reordering::none});
    EXPECT_EQ(bare.bytes(), 64u * 64u / 2u);
}

// "hardly differs" [SF17]: a few per cent, whichever patch is lit.
TEST(Bc1Matrix, LightsARoomAsTheMatrixOfAllBounces)
{
    const TestRoom room = box_room(12);
    const ColorMatrix matrix = all_bounces(room);
    EXPECT_LT(relative_error(decompress(compress_bc1(matrix, {})), matrix, room.elements), 0.03);
}

}  // namespace
}  // namespace lumel
