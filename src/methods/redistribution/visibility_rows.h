#pragma once
// What patches see, kept: V of each patch and lumel, a bit a pair. What is kept needs no hemicube
// when light is shot again or taken back.

#include <span>
#include <vector>

#include "methods/progressive/progressive.h"
#include "methods/redistribution/visibility_rows.record.comp.h"
#include "methods/redistribution/visibility_rows.shared.h"
#include "methods/redistribution/visibility_rows.shoot.comp.h"

namespace lumel {

/// Patches that shoot one after another, with their rows, on the device.
struct ShotList {
    std::vector<ChosenPatch> patches;  ///< in whole batches
    gpu::Array<ChosenPatch> chosen;    ///< the same
    gpu::Array<std::uint32_t> rows;    ///< of each, or kNoRow
    bool empty() const { return patches.empty(); }
};

class VisibilityRows {
public:
    /// Keeps no more than `most_bytes`, nor than one array of the device holds; patches beyond them
    /// have no rows. While it grows there are two arrays. All must outlive it.
    VisibilityRows(const gpu::Device& device, const World& world, ProgressiveRadiosity& solver,
                   Projection projection, std::uint64_t most_bytes);

    /// Makes room for the patches of charts at the levels [C] at which they shoot. Nothing may be
    /// at work on it.
    void follow(std::span<const std::uint32_t> levels);

    /// kNoRow if there is none.
    std::uint32_t row_of(const ChosenPatch& patch) const;
    /// Is what it sees kept?
    bool knows(const ChosenPatch& patch) const;
    void forget(const ChosenPatch& patch);

    /// In whole batches; patches without rows have kNoRow. Empty if there are none.
    ShotList list_of(std::vector<ChosenPatch> patches) const;

    /// Keeps what the batch that begins at `first` of the list, taken and looked from, sees.
    void record(const ShotList& list, std::uint32_t first);
    /// What that batch, taken, sends arrives × sign at all lumels that it saw. Those that are
    /// kLumelMoving receive nothing.
    void shoot(const ShotList& list, std::uint32_t first, float sign);

    gpu::Array<std::uint32_t>& seen() { return seen_; }  ///< visibility_rows.glsl

private:
    /// Rows of a chart at one level.
    struct ChartRows {
        std::uint32_t level = kNoLevel, first = kNoRow;
        std::vector<char> known;  ///< [patches]
    };

    RowsParams params(std::uint32_t first, std::uint32_t last, std::uint32_t place) const;
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
