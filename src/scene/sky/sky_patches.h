#pragma once
// The sky in patches of nearly equal solid angle.

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// The 145 patches of [Tre87], in rows from the horizon up, each divided by an angle of azimuth and
/// of elevation into division × division; the zenith stays whole.
class SkyPatches {
public:
    explicit SkyPatches(std::size_t division = 1);

    static constexpr std::uint32_t kNone = ~0u;

    std::size_t count() const { return patches_.size(); }
    /// Patch of a direction (north is -z, east +x, up +y); kNone below the horizon.
    std::uint32_t at(const glm::vec3& direction) const;
    /// Patch of [Tre87] of which this one is a part.
    std::uint32_t whole(std::size_t patch) const { return patches_[patch].whole; }
    double solid_angle(std::size_t patch) const;  ///< ∫ dω [sr]
    double projected(std::size_t patch) const;    ///< ∫ sin elevation dω: on a horizontal plane
    /// Mean over each patch of a function of direction.
    std::vector<double> means(const std::function<double(const glm::dvec3&)>& of) const;

private:
    struct Patch {
        double low, high;    ///< sine of the elevation
        double from, width;  ///< azimuth [rad] clockwise from north
        std::uint32_t whole;
    };
    struct Row {
        double top;  ///< elevation at which it ends [rad]
        std::size_t first, count;
        double from;  ///< azimuth at which its first patch begins [rad]
    };

    std::vector<Patch> patches_;
    std::vector<Row> rows_;
};

}  // namespace lumel
