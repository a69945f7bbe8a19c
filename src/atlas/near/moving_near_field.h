#pragma once
// The near field of a scene in which things move.

#include <map>
#include <span>
#include <vector>

#include "atlas/near/near_field.h"
#include "atlas/near/near_pairs.h"
#include "base/core/box.h"

namespace lumel {

/// Which pairs of lumels.
enum class NearPairsOf {
    all,
    movers,  ///< one of both, at least, may move
};

/// After any moves it has the pairs and factors, bit for bit, that build_near_field() finds with
/// the radius of the beginning, unless the scene's bounding box has grown or shrunk: rays start as
/// high above lumels as it takes there. (A new build may choose a smaller radius where pairs are
/// many.)
class MovingNearField {
public:
    /// movers [instances]: 1 if it may move. The lumels must outlive this, unmoved.
    MovingNearField(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                    const NearFieldOptions& options, std::vector<char> movers, NearPairsOf which);

    /// Follows instances that now stand elsewhere in the scene. boxes: around all that moved, where
    /// it was and where it is. Builds pairs anew of which one has moved, or that may look through a
    /// box; it keeps the others, but copies the table.
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
    std::vector<float> radius_of_;  ///< [N] of the ball about its centre that a lumel fills [m]
    float most_radius_ = 0.0f, most_lift_ = 0.0f, most_size_ = 0.0f;  ///< of all lumels [m]
    NearField table_;
    /// Rows that were scaled down to 1, by lumel, as they were before: with a pair built anew the
    /// others of its row are scaled anew.
    std::map<std::uint32_t, std::vector<float>> unlimited_;
};

}  // namespace lumel
