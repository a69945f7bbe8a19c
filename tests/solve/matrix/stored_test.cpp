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
    return {compress_tiles(matrix, room.elements, {.error = 0.05f}), compress_bc1(matrix, {}),
            compress_bc1(matrix, {.exact_share = 0.0f, .reordering = Reordering::none})};
}

ColorMatrix whole(const CompressedMatrix& matrix)
{
    return std::visit([](const auto& form) { return decompress(form); }, matrix);
}

CompressedMatrix read(const std::string& bytes)
{
    return from_bytes(bytes, "scene.lumelmat");
}

TEST(StoredMatrix, ComesBackAsItWent)
{
    for (const CompressedMatrix& matrix : one_of_each()) {
        const std::string bytes = to_bytes(matrix);
        const CompressedMatrix back = read(bytes);
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
        const std::string bytes = to_bytes(matrix);
        for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 7)
            EXPECT_THROW(read(bytes.substr(0, length)), Error);
        EXPECT_THROW(read(bytes + '\0'), Error);
    }
}

// Codes of single entries, matrices of low rank and BC1 with two orders have been forms 0, 1 and 3.
TEST(StoredMatrix, InAFormThatIsNoLongerReadIsRefusedInOneSentence)
{
    for (const int form : {0, 1, 3, 5}) {
        std::string bytes = to_bytes(one_of_each()[0]);
        bytes[0] = char(form);
        try {
            read(bytes);
            FAIL() << "form " << form;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_EQ(std::string(error.what()),
                      form < 4 ? "scene.lumelmat: holds a matrix in a form that is no longer read; "
                                 "bake the scene again"
                               : "scene.lumelmat: is damaged; bake the scene again");
        }
    }
}

// Refused, or a matrix all the same: one number is as good as another.
TEST(StoredMatrix, AlteredNeverCrashes)
{
    std::mt19937 random(3);
    for (const CompressedMatrix& matrix : one_of_each()) {
        const std::string bytes = to_bytes(matrix);
        for (int round = 0; round < 200; ++round) {
            std::string altered = bytes;
            // Every second time where the numbers that others depend on are.
            const std::size_t range = round % 2 == 0 ? altered.size() : 64;
            altered[random() % range] = char(random() & 255u);
            try {
                EXPECT_EQ(whole(read(altered)).size(), size_of(matrix));
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::input);
            }
        }
    }
}

}  // namespace
}  // namespace lumel
