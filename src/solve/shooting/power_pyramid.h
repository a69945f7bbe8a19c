#pragma once
// Hierarchical sums of lumel power on the GPU, for importance sampling ([BSS05] section 4.1).

#include "gpu/commands.h"
#include "solve/shooting/power_pyramid.leaves.comp.h"
#include "solve/shooting/power_pyramid.shared.h"
#include "solve/shooting/power_pyramid.sum.comp.h"

namespace lumel {

/// Fraction of shooters drawn by area instead of power; dark rooms need it.
inline constexpr float kDefensiveShare = 0.15f;

/// Tree of sums whose leaves are the powers of the lumels. Read by power_pyramid.glsl.
class PowerPyramid {
public:
    PowerPyramid(const gpu::Device& device, std::size_t lumel_count);

    /// Records the sums of leaf weights 𝓛(X_j) A_j, of which the fraction `by_area` is distributed
    /// by area. source [N] vec3: X; surface [N] vec4: ρ, A; area_sum: Σ A of reflecting lumels.
    void build(gpu::Commands& commands, const gpu::Array<glm::vec3>& source,
               const gpu::Array<glm::vec4>& surface, float by_area, float area_sum);

    static std::uint64_t device_bytes(std::size_t lumel_count);

    const gpu::Array<float>& array() const { return array_; }
    const PyramidLayout& layout() const { return layout_; }

private:
    void sum_levels(gpu::Commands& commands);

    PyramidLayout layout_;
    gpu::Array<float> array_, power_;
    gpu::Kernel<shaders::PowerPyramidLeaves> leaves_;
    gpu::Kernel<shaders::PowerPyramidSum> sum_;
    std::size_t count_;
};

}  // namespace lumel
