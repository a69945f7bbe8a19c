// The GPU's products are those of the matrix that is stored.

#include <random>

#include <gtest/gtest.h>

#include "solve/matrix/bounces.h"
#include "solve/matrix/multiply.h"
#include "tests/solve/matrix/random_matrix.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel {
namespace {

constexpr std::uint32_t kSize = 203;  // no multiple of anything

std::vector<glm::vec3> random_light(std::size_t count)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<glm::vec3> light(count);
    for (glm::vec3& color : light)
        color = {unit(random), unit(random), unit(random)};
    return light;
}

/// A form by which it was made, its product on the GPU, for some states.
template <class Product>
std::vector<glm::vec3> on_gpu(const gpu::Device& device, Product product,
                              const std::vector<glm::vec3>& x, std::uint32_t states)
{
    const gpu::Array<glm::vec3> from(device, std::span<const glm::vec3>(x));
    const gpu::Array<glm::vec3> to(device, x.size());
    gpu::Commands commands(device);
    product.record(commands, from, to, states);
    commands.run();
    return to.download();
}

/// Each state's colours within `tolerance` of those by the matrix, relative to the largest.
void expect_products(const std::vector<glm::vec3>& found, const ColorMatrix& matrix,
                     const std::vector<glm::vec3>& x, float tolerance)
{
    const std::size_t n = matrix.size();
    for (std::size_t first = 0; first < x.size(); first += n) {
        const std::vector<glm::vec3> wanted = multiply(matrix, std::span(x).subspan(first, n));
        glm::vec3 largest(0.0f);
        for (const glm::vec3& color : wanted)
            largest = glm::max(largest, color);
        for (std::size_t i = 0; i < n; ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(found[first + i][c], wanted[i][c], tolerance * largest[c])
                    << "state " << first / n << ", patch " << i << ", channel " << c;
    }
}

constexpr float kSumRounding = 1e-5f;    // of 32-bit sums of a few hundred
constexpr float kPowerRounding = 1e-4f;  // Vulkan's exp2, at exponents of up to −36

TEST(MultiplyOnGpu, IsTheStoredMatrixForEveryCode)
{
    const gpu::Device device;
    const ColorMatrix matrix = shuffled_kernel(kSize, 1);
    for (const Code code : {Code::float32, Code::float16, Code::log8, Code::bc1, Code::bc4})
        for (const std::uint32_t states : {1u, 6u}) {
            const CodedMatrix coded = encode(matrix, {.code = code});
            const std::vector<glm::vec3> x = random_light(std::size_t(states) * kSize);
            SCOPED_TRACE(int(code));
            expect_products(
                on_gpu(device, MultiplyCoded(device, coded, states, Decoder::shader), x, states),
                decode(coded), x, kPowerRounding);
        }
    EXPECT_EQ(device.validation_messages(), "");
}

// Hardware mixes a block's colours with fewer digits: by 1.6 of 255 codes at most on llvmpipe.
TEST(MultiplyOnGpu, OfATextureIsTheStoredMatrixWithinTheHardwaresMixing)
{
    const gpu::Device device;
    if (!device.can_read_blocks())
        GTEST_SKIP() << "the device has no block textures";
    const ColorMatrix matrix = shuffled_kernel(kSize, 1);
    const CodedMatrix coded = encode(matrix, {.code = Code::bc1, .offset = 8.0f});
    const std::vector<glm::vec3> x = random_light(kSize);
    expect_products(on_gpu(device, MultiplyCoded(device, coded, 1, Decoder::hardware), x, 1),
                    decode(coded), x, std::exp(1.6f * 8.0f / 255.0f) - 1.0f);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(MultiplyOnGpu, IsTheStoredMatrixOfLowRank)
{
    const gpu::Device device;
    const TestRoom room = sphere_room(kSize, 2);
    const ColorMatrix once = color_matrix(room.form_factors, room.elements.color);
    const LowRankMatrix compressed = compress_low_rank(once, room.elements, 9);
    const std::vector<glm::vec3> x = random_light(3 * kSize);
    expect_products(on_gpu(device, Multiply(device, compressed, 3), x, 3), decompress(compressed),
                    x, kSumRounding);
    EXPECT_EQ(device.validation_messages(), "");
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
