// Compressed matrices as bytes.

#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "solve/matrix/bounces.h"
#include "solve/matrix/stored.h"
#include "tests/solve/matrix/random_matrix.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel {
namespace {

std::vector<CompressedMatrix> one_of_each()
{
    const TestRoom room = sphere_room(70, 1);
    const ColorMatrix matrix = shuffled_kernel(70, 2);
    std::vector<CompressedMatrix> forms;
    for (const Code code : {Code::float32, Code::float16, Code::log8, Code::bc1, Code::bc4})
        forms.emplace_back(encode(matrix, {.code = code}));
    forms.emplace_back(compress_low_rank(matrix, room.elements, 7));
    forms.emplace_back(compress_tiles(matrix, room.elements, {.error = 0.05f}));
    return forms;
}

ColorMatrix whole(const CompressedMatrix& matrix)
{
    if (const auto* coded = std::get_if<CodedMatrix>(&matrix))
        return decode(*coded);
    if (const auto* low_rank = std::get_if<LowRankMatrix>(&matrix))
        return decompress(*low_rank);
    return decompress(std::get<TiledMatrix>(matrix));
}

TEST(StoredMatrix, ComesBackAsItWent)
{
    for (const CompressedMatrix& matrix : one_of_each()) {
        const std::vector<std::byte> bytes = to_bytes(matrix);
        const CompressedMatrix back = from_bytes(bytes);
        EXPECT_EQ(to_bytes(back), bytes);
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(whole(back).channel[c].values, whole(matrix).channel[c].values);
    }
}

// Lengths of lists and a few numbers come on top.
TEST(StoredMatrix, TakesTheBytesThatItSays)
{
    for (const CompressedMatrix& matrix : one_of_each()) {
        EXPECT_GE(to_bytes(matrix).size(), bytes_of(matrix));
        EXPECT_LT(to_bytes(matrix).size(), bytes_of(matrix) + 400);
    }
}

TEST(StoredMatrix, CutShortIsRefused)
{
    for (const CompressedMatrix& matrix : one_of_each()) {
        const std::vector<std::byte> bytes = to_bytes(matrix);
        for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 7)
            EXPECT_THROW(from_bytes(std::span(bytes).first(length)), Error);
        std::vector<std::byte> longer = bytes;
        longer.push_back(std::byte{0});
        EXPECT_THROW(from_bytes(longer), Error);
    }
}

// Refused, or a matrix all the same: one number is as good as another.
TEST(StoredMatrix, AlteredNeverCrashes)
{
    std::mt19937 random(3);
    for (const CompressedMatrix& matrix : one_of_each()) {
        const std::vector<std::byte> bytes = to_bytes(matrix);
        for (int round = 0; round < 200; ++round) {
            std::vector<std::byte> altered = bytes;
            // Every second time where the numbers that others depend on are.
            const std::size_t range = round % 2 == 0 ? altered.size() : 64;
            altered[random() % range] = std::byte(random() & 255u);
            try {
                EXPECT_EQ(whole(from_bytes(altered)).size(), size_of(matrix));
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::input);
            }
        }
    }
}

}  // namespace
}  // namespace lumel
