#pragma once
// Movable objects in the light of lamps, for cross redistribution: rendered from the lamps, since
// backs of objects would show a small lamp as a few pixels. See lamp_shadows.cpp.

#include <optional>
#include <span>
#include <vector>

#include "base/core/box.h"
#include "methods/redistribution/incremental.h"

namespace lumel {

/// Points from which a lamp's lumels cast shadows of objects in `boxes` [1…most]. A point stands
/// for a part of the lamp h = √(area / points) wide. An object at distance a displaces the shadow
/// of that part by up to h (b - a) / 2a on a surface at distance b: at most a quarter of `side`,
/// the width of a lumel [m], for all surfaces inside `world`.
double lamp_points(std::span<const Lumel> lamp, const std::vector<MovedBox>& boxes,
                   const Box& world, double side, double most);

/// Lamps are static charts with an emissive lumel.
class LampShadows {
public:
    /// movers [instances]: 1 if movable. most_points: of a lamp. most_bytes: VisibilityRows. The
    /// first four must outlive this.
    LampShadows(const gpu::Device& device, World& world, const Lumels& lumels,
                ProgressiveRadiosity& solver, std::vector<char> movers, std::uint32_t most_points,
                std::uint64_t most_bytes);

    /// [N] 1: lumel of a lamp.
    const gpu::Array<std::uint32_t>& lamps() const { return is_lamp_; }

    /// Starts to recompute the light for the current positions of objects, unless nothing has moved
    /// and the lamps' light has changed by at most `tolerance`. boxes: bounds of movable objects.
    void begin(const std::vector<MovedBox>& boxes, bool has_moved, double tolerance);
    /// Runs one batch. Returns false when finished.
    bool step();
    bool is_under_way() const { return list_.has_value(); }

    /// [N] light of the lamps [lx]: received by movable lumels; for others, the light that objects
    /// occlude, negative.
    const gpu::Array<glm::vec3>& light() const { return light_; }
    std::uint64_t hemicubes() const { return hemicubes_; }  ///< total

private:
    std::vector<std::uint32_t> levels(const std::vector<MovedBox>& boxes);
    std::vector<ChosenPatch> patches_to_shoot(const Move& around);
    void look(bool shows_movers);
    void receive(float sign);

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    VisibilityRows rows_;  ///< for the world without movable objects
    std::vector<char> movers_;
    std::vector<std::uint32_t> lamp_of_;  ///< [N]
    PairRedistribution pairs_;
    gpu::Array<std::uint32_t> is_lamp_;
    gpu::Array<glm::vec3> light_;
    double side_;  ///< of a mean lumel [m]
    double most_points_;
    std::vector<std::uint32_t> least_;  ///< [C] coarsest level that moves so far allow
    std::vector<glm::vec3> shot_;       ///< [N] B^s of the lamps when light_ was computed
    std::optional<ShotList> list_;      ///< present while in progress
    std::uint32_t next_ = 0;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
