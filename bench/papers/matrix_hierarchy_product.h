#pragma once
// A matrix in a hierarchy of blocks times colours of patches, on the GPU: all V^T, then all U and
// dense blocks.

#include "bench/papers/matrix_hierarchy.dot.comp.h"
#include "bench/papers/matrix_hierarchy.h"
#include "solve/matrix/vectors.h"

namespace lumel::bench {

class MultiplyHierarchy {
public:
    /// For one vector at once: states is 1. Throws Error{device}.
    MultiplyHierarchy(const gpu::Device& device, const HierarchicalMatrix& matrix,
                      std::uint32_t states);

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, std::uint32_t states);

private:
    /// Rows, each with its segments of values.
    struct Rows {
        std::vector<std::uint32_t> first{0};
        std::vector<HierarchySegment> segments;
        std::vector<std::uint32_t> words;
    };
    struct RowsOnDevice {
        RowsOnDevice(const gpu::Device& device, Rows rows);

        std::uint32_t count;
        gpu::Array<std::uint32_t> first;
        gpu::Array<HierarchySegment> segments;
        gpu::Array<std::uint32_t> words;
    };

    static void add(Rows& rows, std::span<const std::uint16_t> values, std::uint32_t source,
                    bool seen);
    static Rows seeing_rows(const HierarchicalMatrix& matrix, std::uint32_t width);
    static Rows sending_rows(const HierarchicalMatrix& matrix, std::uint32_t width);
    void record(gpu::Commands& commands, const RowsOnDevice& rows, const gpu::Array<float>& result,
                std::uint32_t plane, const glm::vec3& scale);

    std::uint32_t width_;
    glm::vec3 unit_;
    RowsOnDevice see_, send_;
    gpu::Array<float> in_, seen_, out_;
    Gather gather_;
    Scatter scatter_;
    gpu::Kernel<shaders::MatrixHierarchyDot> kernel_;
};

}  // namespace lumel::bench
