// What compressed matrices cost on scenes: light through what was stored against light through the
// matrix itself.

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "bench/papers/matrix_case.h"
#include "bench/papers/matrix_codes.h"
#include "solve/matrix/compressed_tiles.h"

namespace lumel::bench {
namespace {

constexpr std::uint32_t kPatches = 2048;  // several thousand in the paper
constexpr int kLights = 16;

MatrixCase matrix_of(const char* scene)
{
    const gpu::Device device;
    Settings settings;
    settings.scene = support::source_path(scene);
    MatrixCase found = make_matrix_case(device, settings, kPatches, kLights);
    EXPECT_EQ(device.validation_messages(), "");
    return found;
}

/// Bytes of the form factors as floats, over those of a form.
double saving(const MatrixCase& matrix_case, std::size_t bytes)
{
    return 4.0 * double(matrix_case.size()) * double(matrix_case.size()) / double(bytes);
}

// "requires 3 times less memory" and "hardly differs" [SF17], which we take for 2 % of indirect
// light, in the paper's format, with its 4 % and its offset of 25, by our encoder.
void expect_papers_blocks(const MatrixCase& matrix_case)
{
    const CodedMatrix coded = encode(matrix_case.bounces, {});
    EXPECT_GE(saving(matrix_case, coded.bytes()), 3.0);
    EXPECT_LE(light_error(matrix_case, decode(coded)).mean, 0.02);
}

// Ours: 1 % of error in a twelfth of the bytes.
void expect_tiles(const MatrixCase& matrix_case)
{
    const TiledMatrix tiles =
        compress_tiles(matrix_case.bounces, matrix_case.elements, {.error = 0.01f});
    EXPECT_GE(saving(matrix_case, tiles.bytes()), 12.0);
    EXPECT_LE(light_error(matrix_case, decompress(tiles)).mean, 0.01);
}

TEST(CompressedMatrix, OfTheCornellBox)
{
    const MatrixCase matrix_case = matrix_of("scenes/cornell-box.gltf");
    expect_papers_blocks(matrix_case);
    expect_tiles(matrix_case);
}

TEST(CompressedMatrix, OfTheRoom)
{
    const MatrixCase matrix_case = matrix_of("scenes/room.gltf");
    expect_papers_blocks(matrix_case);
    expect_tiles(matrix_case);
}

}  // namespace
}  // namespace lumel::bench
