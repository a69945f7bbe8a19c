#pragma once
// Stored visibility V of each patch and lumel, one bit per pair: light can be shot again or taken
// back without hemicubes.

#include <span>
#include <vector>

#include "methods/progressive/progressive.h"
#include "methods/progressive/visibility_rows.record.comp.h"
#include "methods/progressive/visibility_rows.shared.h"
#include "methods/progressive/visibility_rows.shoot.comp.h"

namespace lumel {

/// Patches that shoot in order, with their rows, on the device.
struct ShotList {
    std::vector<ChosenPatch> patches;  ///< in whole batches
    gpu::Array<ChosenPatch> chosen;    ///< patches on the device
    gpu::Array<std::uint32_t> rows;    ///< row of each, or kNoRow
    bool empty() const { return patches.empty(); }
};

class VisibilityRows {
public:
    /// Stores at most `most_bytes`, or one array of the device; patches beyond them have no rows.
    /// There are two arrays while it grows. All must outlive this.
    VisibilityRows(const gpu::Device& device, const World& world, ProgressiveRadiosity& solver,
                   Projection projection, std::uint64_t most_bytes);

    /// Allocates rows for patches of charts at their shooting levels [C]. Requires that no work is
    /// using the rows.
    void follow(std::span<const std::uint32_t> levels);

    /// kNoRow if there is none.
    std::uint32_t row_of(const ChosenPatch& patch) const;
    /// True if its visibility is stored.
    bool knows(const ChosenPatch& patch) const;
    void forget(const ChosenPatch& patch);

    /// In whole batches; patches without rows have kNoRow. Empty if there are no patches.
    ShotList list_of(std::vector<ChosenPatch> patches) const;

    /// Stores the visibility of the batch at `first` of the list. Requires that it is taken and
    /// rendered.
    void record(const ShotList& list, std::uint32_t first);
    /// Adds light of that batch × sign to all lumels that it saw, except kLumelMoving ones.
    /// Requires that it is taken.
    void shoot(const ShotList& list, std::uint32_t first, float sign);

    /// Parameters of kernels for that batch.
    RowsBatch batch(std::uint32_t first, float sign) const;
    gpu::Array<std::uint32_t>& seen() { return seen_; }  ///< visibility_rows.glsl

private:
    /// Rows of a chart at one level.
    struct ChartRows {
        std::uint32_t level = kNoLevel, first = kNoRow;
        std::vector<char> known;  ///< [patches]
    };

    void make_room(std::uint32_t rows);
    std::uint32_t most_words() const;

    const gpu::Device* device_;
    const World* world_;
    ProgressiveRadiosity* solver_;
    std::uint64_t most_bytes_;
    std::uint32_t count_;  ///< N
    gpu::Kernel<shaders::VisibilityRowsRecord> record_;
    gpu::Kernel<shaders::VisibilityRowsShoot> shoot_;
    gpu::Array<std::uint32_t> seen_;  ///< [rows / 32][N]
    std::vector<ChartRows> charts_;
    std::uint32_t rows_ = 0;  ///< in use
};

}  // namespace lumel
