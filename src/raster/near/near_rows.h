#pragma once
// The near field on the GPU.

#include "atlas/near/near_field.h"
#include "gpu/commands.h"
#include "raster/near/near_rows.comp.h"

namespace lumel {

/// Sparse rows of a NearField, and their product with a vector.
class NearRows {
public:
    NearRows(const gpu::Device& device, const NearField& near, std::size_t lumel_count);

    static std::uint64_t device_bytes(std::size_t lumel_count, std::uint64_t pairs);

    /// Replaces the table. The GPU must not be using the previous one.
    void replace(const NearField& near);

    /// result_i = Σ_j F_ij source_j. source, result: [N].
    void light(gpu::Commands& commands, const gpu::Array<glm::vec3>& source,
               const gpu::Array<glm::vec3>& result) const;

    const gpu::Array<std::uint32_t>& first() const { return first_; }    ///< [N + 1]
    const gpu::Array<std::uint32_t>& column() const { return column_; }  ///< [nnz]
    const gpu::Array<float>& factor() const { return factor_; }          ///< [nnz] F_ij

private:
    const gpu::Device* device_;
    std::uint32_t count_;
    gpu::Array<std::uint32_t> first_, column_;
    gpu::Array<float> factor_;
    gpu::Kernel<shaders::NearRows> kernel_;
};

}  // namespace lumel
