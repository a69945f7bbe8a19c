#pragma once
// Products of the GPU beside those of the matrix itself.

#include <random>

#include <gtest/gtest.h>

#include "gpu/commands.h"
#include "solve/matrix/bounces.h"

namespace lumel {

inline std::vector<glm::vec3> random_light(std::size_t count)
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
inline void expect_products(const std::vector<glm::vec3>& found, const ColorMatrix& matrix,
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

inline constexpr float kSumRounding = 1e-5f;    // of 32-bit sums of a few hundred
inline constexpr float kPowerRounding = 1e-4f;  // Vulkan's exp2, at exponents of up to −36

}  // namespace lumel
