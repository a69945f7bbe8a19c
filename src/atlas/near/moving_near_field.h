#pragma once
// Near field of a scene with moving objects.

#include <map>
#include <span>
#include <vector>

#include "atlas/near/near_field.h"
#include "atlas/near/near_pairs.h"
#include "base/core/box.h"

namespace lumel {

/// Selection of pairs.
enum class NearPairsOf {
    all,
    movers,  ///< at least one of both is movable
};

/// After any moves the table equals, bit for bit, that of build_near_field() with the initial
/// radius, unless the scene's bounding box has changed, which defines the ray offset. (A new build
/// may choose a smaller radius if there are many pairs.)
class MovingNearField {
public:
    /// movers [instances]: 1 if movable. The lumels must outlive this and not move.
    MovingNearField(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                    const NearFieldOptions& options, std::vector<char> movers, NearPairsOf which);

    /// Updates the table after moves of instances. boxes: around all moved objects, before and
    /// after. Rebuilds pairs that have moved or may cross a box; copies the others.
    void follow(const Scene& scene, const RayScene& rays, std::span<const std::uint32_t> moved,
                std::span<const Box> boxes);

    /// Columns ascend in each row.
    const NearField& table() const { return table_; }

private:
    bool is_of(std::uint32_t i, std::uint32_t j) const;
    bool may_cross(std::uint32_t i, std::uint32_t j, std::span<const Box> boxes) const;
    std::vector<std::uint32_t> lumels_near(std::span<const Box> boxes) const;
    void build(const RayScene& rays, std::vector<std::uint32_t> some, const WantsPair& wants);
    void merge(std::uint32_t lumel, std::span<const std::uint32_t> columns,
               std::span<const float> factors, const WantsPair& wants, NearField& into);

    const Lumels* lumels_;
    NearFieldOptions options_;
    std::vector<char> movers_;  ///< [instances]
    NearPairsOf which_;
    WorldLumels world_;
    std::vector<float> radius_of_;  ///< [N] bounding radius about the centre [m]
    float most_radius_ = 0.0f, most_lift_ = 0.0f, most_size_ = 0.0f;  ///< maxima [m]
    NearField table_;
    /// Original values of rows that were scaled down to 1, by lumel: a rebuilt pair changes the
    /// scale of its row.
    std::map<std::uint32_t, std::vector<float>> unlimited_;
};

}  // namespace lumel
