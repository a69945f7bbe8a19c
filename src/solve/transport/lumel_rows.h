#pragma once
// From what patches send to light on lumels. See lumel_rows.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "solve/transport/lumel_rows.shared.h"

namespace lumel {

/// The row of form factors of each lumel by itself: H_i = Σ_p F_ip B_p.
struct LumelRows {
    std::vector<std::uint32_t> first;  ///< [N + 1] into entry
    std::vector<RowEntry> entry;       ///< [nnz] patches ascend in each row

    std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }  ///< N
    /// sent: [n] lm/m² of the patches. Returns [N] lx.
    std::vector<glm::vec3> apply(std::span<const glm::vec3> sent) const;
};

/// Keeps what lumels receive of patches, column by column.
class LumelRowsBuilder {
public:
    /// Of this number of lumels and patches.
    LumelRowsBuilder(std::size_t lumels, std::size_t patches);

    /// Bytes on the host while rows are made, of lumels that see half of the patches.
    static std::uint64_t host_bytes(std::size_t lumels, std::size_t patches);

    /// What lumels [N] receive of the patch that comes next if its radiosity is 1.
    void add(std::span<const float> received);

    /// Once all are added. closed [N]: lumels whose rows add up to 1; others have what was added,
    /// or 1 if that was more.
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
