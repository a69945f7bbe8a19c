#pragma once
// Vectors times a matrix that the GPU reads row by row.

#include <map>
#include <span>
#include <variant>

#include <glm/glm.hpp>

#include "bench/papers/matrix_codes.h"
#include "bench/papers/matrix_rows.bc1.comp.h"
#include "bench/papers/matrix_rows.bc4.comp.h"
#include "bench/papers/matrix_rows.float.comp.h"
#include "bench/papers/matrix_rows.half.comp.h"
#include "bench/papers/matrix_rows.log8.comp.h"
#include "gpu/commands.h"

namespace lumel::bench {

/// What a code stands for, for each plane.
struct Decoding {
    glm::vec3 largest{1.0f};  ///< float16: kLargestHalf; logarithms: code 255
    float offset = 1.0f;      ///< logarithms: what code 0 lies below the largest
};

/// y = M x, of either three matrices, one for each channel, or one for all channels.
class RowsProduct {
public:
    /// words: of each plane, or of bc1's one image, as CodedMatrix has them; one plane serves all
    /// channels. M has `rows` rows of `columns` entries. Throws Error{device} if there is no room.
    RowsProduct(const gpu::Device& device, Code code,
                std::span<const std::vector<std::uint32_t>> words, std::uint32_t rows,
                std::uint32_t columns, const Decoding& decoding);

    /// x [states][3][filled_up(columns)], filled with 0; y [states][3][y_width].
    void record(gpu::Commands& commands, const gpu::Array<float>& x, const gpu::Array<float>& y,
                std::uint32_t y_width, std::uint32_t states);

    std::uint64_t bytes() const { return bytes_; }  ///< of the matrix on the device

private:
    /// Rows that one array holds.
    struct Part {
        std::uint32_t first_row, rows;
        gpu::Array<std::uint32_t> words;
    };

    void upload(std::span<const std::vector<std::uint32_t>> words);
    using ProductKernel =
        std::variant<gpu::Kernel<shaders::MatrixRowsFloat>, gpu::Kernel<shaders::MatrixRowsHalf>,
                     gpu::Kernel<shaders::MatrixRowsLog8>, gpu::Kernel<shaders::MatrixRowsBc4>,
                     gpu::Kernel<shaders::MatrixRowsBc1>>;
    ProductKernel make_kernel(std::uint32_t vectors) const;
    const ProductKernel& kernel(std::uint32_t vectors);
    template <class Shader>
    void record_all(gpu::Commands& commands, const gpu::Kernel<Shader>& kernel,
                    const gpu::Array<float>& x, const gpu::Array<float>& y, ProductParams params);

    const gpu::Device* device_;
    Code code_;
    bool one_for_all_;
    std::uint32_t rows_, plane_rows_, quads_;
    Decoding decoding_;
    std::uint64_t bytes_ = 0;
    std::vector<Part> parts_;
    std::map<std::uint32_t, ProductKernel> kernels_;  ///< by the vectors that they take at once
};

}  // namespace lumel::bench
