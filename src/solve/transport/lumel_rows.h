#pragma once
// Light from patches to lumels. See lumel_rows.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "solve/transport/lumel_rows.shared.h"

namespace lumel {

/// Form factors of each lumel: H_i = Σ_p F_ip B_p.
struct LumelRows {
    std::vector<std::uint32_t> first;  ///< [N + 1] into entry
    std::vector<RowEntry> entry;       ///< [nnz] patches ascend in each row

    std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }  ///< N
    /// sent: [n] radiosity of patches [lm/m²]. Returns irradiance [N] [lx].
    std::vector<glm::vec3> apply(std::span<const glm::vec3> sent) const;
};

/// Collects form factors of lumels, column by column.
class LumelRowsBuilder {
public:
    LumelRowsBuilder(std::size_t lumels, std::size_t patches);

    /// Host memory during construction [bytes], if lumels see half of the patches.
    static std::uint64_t host_bytes(std::size_t lumels, std::size_t patches);

    /// Adds the next patch: irradiance [N] of lumels if its radiosity is 1.
    void add(std::span<const float> received);

    /// Call after the last add(). closed [N]: rows of these lumels are scaled to sum to 1; others
    /// keep their sum, at most 1.
    LumelRows finish(std::span<const char> closed);

private:
    struct Column {
        std::vector<std::uint32_t> lumel;
        std::vector<float> factor;
    };

    std::size_t lumels_, patches_;
    std::vector<double> sum_;      ///< [N]
    std::vector<Column> columns_;  ///< [n]
};

}  // namespace lumel
