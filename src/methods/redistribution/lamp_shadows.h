#pragma once
// What moves in the light of lamps, for cross redistribution: found by views from the lamps, where
// the backs of what moves would show a small lamp as a few pixels. See lamp_shadows.cpp.

#include <optional>
#include <vector>

#include "methods/redistribution/incremental.h"

namespace lumel {

/// Lamps are charts of which a lumel shines by itself, and that do not move.
class LampShadows {
public:
    /// movers [instances]: 1 if it may move. most_bytes: VisibilityRows. All must outlive it.
    LampShadows(const gpu::Device& device, World& world, const Lumels& lumels,
                ProgressiveRadiosity& solver, std::vector<char> movers, std::uint64_t most_bytes);

    /// [N] 1: a lamp's.
    const gpu::Array<std::uint32_t>& lamps() const { return is_lamp_; }

    /// Begins to find anew what arrives where movers are now in the world: at most `tolerance` of
    /// the lamps' light may have changed for what was found before to hold. boxes: around movers.
    void begin(const std::vector<MovedBox>& boxes, bool has_moved, double tolerance);
    /// One batch. False once nothing is left to do.
    bool step();
    bool is_under_way() const { return list_.has_value(); }

    /// [N] light of the lamps [lx]: what moving lumels receive; what movers keep from the others,
    /// as a negative number.
    const gpu::Array<glm::vec3>& light() const { return light_; }
    std::uint64_t hemicubes() const { return hemicubes_; }  ///< so far

private:
    std::vector<std::uint32_t> levels() const;
    std::vector<ChosenPatch> patches_to_shoot(const Move& around);
    void look(bool shows_movers);
    void receive(float sign);

    const gpu::Device* device_;
    World* world_;
    const Lumels* lumels_;
    ProgressiveRadiosity* solver_;
    VisibilityRows rows_;  ///< of the world without movers
    std::vector<char> movers_;
    std::vector<std::uint32_t> lamp_of_;  ///< [N]
    gpu::Kernel<shaders::IncrementalReceive> receive_;
    gpu::Array<std::uint32_t> is_lamp_, moved_;
    gpu::Array<MovedBox> boxes_;
    gpu::Array<glm::vec3> light_;
    std::vector<glm::vec3> shot_;   ///< [N] B^s of the lamps that light_ is of
    std::optional<ShotList> list_;  ///< under way
    std::uint32_t next_ = 0;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace lumel
