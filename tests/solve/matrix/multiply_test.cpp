// The GPU's products are those of the matrix that is stored.

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "solve/matrix/multiply.h"
#include "tests/solve/matrix/products.h"
#include "tests/solve/matrix/random_matrix.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel {
namespace {

constexpr std::uint32_t kSize = 203;  // no multiple of anything

// Hardware mixes a block's colours with fewer digits: by 1.6 of 255 codes at most on llvmpipe.
TEST(MultiplyOnGpu, OfATextureIsTheStoredMatrixWithinTheHardwaresMixing)
{
    const gpu::Device device;
    if (!device.can_read_blocks())
        GTEST_SKIP() << "the device has no block textures";
    const ColorMatrix matrix = shuffled_kernel(kSize, 1);
    const Bc1Matrix compressed = compress_bc1(matrix, {.offset = 8.0f});
    for (const std::uint32_t states : {1u, 6u}) {
        const std::vector<glm::vec3> x = random_light(std::size_t(states) * kSize);
        expect_products(on_gpu(device, Multiply(device, compressed, states), x, states),
                        decompress(compressed), x, std::exp(1.6f * 8.0f / 255.0f) - 1.0f);
    }
    EXPECT_EQ(device.validation_messages(), "");
}

// Where all texels of a block are its first colour, hardware has nothing to mix.
TEST(MultiplyOnGpu, OfATextureOfSingleColoursIsTheStoredMatrix)
{
    const gpu::Device device;
    if (!device.can_read_blocks())
        GTEST_SKIP() << "the device has no block textures";
    Bc1Matrix compressed = compress_bc1(shuffled_kernel(kSize, 1), {});
    for (std::size_t block = 0; block < compressed.blocks.size() / 2; ++block)
        compressed.blocks[2 * block + 1] = 0u;  // the first colour for all texels
    const std::vector<glm::vec3> x = random_light(2 * kSize);
    expect_products(on_gpu(device, Multiply(device, compressed, 2), x, 2), decompress(compressed),
                    x, kPowerRounding);
    EXPECT_EQ(device.validation_messages(), "");
}

// A host that leaves textureCompressionBC off.
TEST(MultiplyOnGpu, OfATextureOnADeviceWithoutBlockTexturesIsRefusedInOneSentence)
{
    const gpu::Device host;
    const gpu::Device guest({.instance = host.instance(),
                             .physical = host.physical(),
                             .device = host.handle(),
                             .queue = host.queue(),
                             .queue_family = host.queue_family()});
    try {
        const Multiply product(guest, compress_bc1(shuffled_kernel(16, 1), {}), 1);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::device);
        EXPECT_EQ(std::string(error.what()),
                  guest.info().name + ": has no BC1 textures, which this matrix is stored in; bake "
                                      "the scene with --form tiles");
    }
}

TEST(MultiplyOnGpu, IsTheStoredMatrixOfTiles)
{
    const gpu::Device device;
    TestRoom room = sphere_room(kSize, 3);
    const ColorMatrix kernel = shuffled_kernel(kSize, 4);
    const TiledMatrix compressed = compress_tiles(kernel, room.elements, {.error = 0.02f});
    for (const std::array<TileRows, 3>& axes : compressed.tiles)
        EXPECT_FALSE(axes[0].place.empty());
    const std::vector<glm::vec3> x = random_light(2 * kSize);
    expect_products(on_gpu(device, Multiply(device, compressed, 2), x, 2), decompress(compressed),
                    x, kSumRounding);
    EXPECT_EQ(device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel
