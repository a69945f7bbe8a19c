#pragma once
// Colours of patches as a matrix on the GPU reads and writes them: planes of floats, one for each
// channel of each state, [states][3][width].

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "solve/matrix/sparse_part.h"
#include "solve/matrix/vectors.gather.comp.h"
#include "solve/matrix/vectors.scatter.comp.h"

namespace lumel {

/// From the caller's colours to planes.
class Gather {
public:
    /// order [n]: the patch at each place, empty: as they are; weight [n], by patch, empty: 1.
    Gather(const gpu::Device& device, std::uint32_t count, std::uint32_t width,
           std::span<const std::uint32_t> order, std::span<const glm::vec3> weight);

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<float>& planes, std::uint32_t states) const;

private:
    std::uint32_t count_, width_;
    gpu::Array<std::uint32_t> order_;
    gpu::Array<glm::vec3> weight_;
    gpu::Kernel<shaders::VectorsGather> kernel_;
};

/// From planes to the caller's colours, the exact part added.
class Scatter {
public:
    /// order [n]: the patch at each place, empty: as they are; weight [n], by patch, empty: 1.
    Scatter(const gpu::Device& device, std::uint32_t count, std::uint32_t width,
            std::span<const std::uint32_t> order, std::span<const float> weight,
            const SparsePart& exact);

    void record(gpu::Commands& commands, const gpu::Array<float>& planes,
                const gpu::Array<glm::vec3>& x, const gpu::Array<glm::vec3>& y,
                std::uint32_t states) const;

private:
    std::uint32_t count_, width_, per_row_;
    gpu::Array<std::uint32_t> place_;
    gpu::Array<float> weight_;
    gpu::Array<std::uint32_t> columns_;
    gpu::Array<float> values_;
    gpu::Kernel<shaders::VectorsScatter> kernel_;
};

}  // namespace lumel
