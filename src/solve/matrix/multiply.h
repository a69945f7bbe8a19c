#pragma once
// A stored matrix times colours of patches, on the GPU.

#include "solve/matrix/compressed.h"
#include "solve/matrix/multiply_bc1.h"
#include "solve/matrix/multiply_tiles.h"

namespace lumel {

/// y = M x for some states of light at once. Sums are of 32-bit floats, in an order that never
/// changes.
class Multiply {
public:
    /// For at most `states` at once. Throws Error{device} if there is no room.
    Multiply(const gpu::Device& device, const CompressedMatrix& matrix, std::uint32_t states = 1);

    /// x, y [states][n]
    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, std::uint32_t states = 1);

private:
    std::variant<MultiplyTiles, MultiplyBc1> form_;
};

}  // namespace lumel
