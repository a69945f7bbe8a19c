#pragma once
// The room that every engine lights, its edits, and their path-traced references.

#include <map>
#include <string>
#include <vector>

#include "../support/temporary_folder.h"
#include "links/live/live_links.h"

namespace lumel::test {

inline constexpr int kSide = 48;         ///< of the atlas [texels]
inline constexpr float kDimmed = 0.25f;  ///< factor to the light of the ceiling
inline constexpr const char *kBlock = "short block", *kLight = "light";
inline const glm::vec3 kMove(0.06f, 0.0f, -0.03f);  ///< of the block [m]

/// The Cornell box with a lamp in it beside its shining ceiling: as it is; with a block elsewhere;
/// with the ceiling's light dimmed.
enum class Room { given, moved, dimmed };

/// The rooms as files of a folder.
class RoomFiles {
public:
    RoomFiles();
    const std::string& path(Room room) const { return paths_.at(room); }

private:
    TemporaryFolder folder_;
    std::map<Room, std::string> paths_;
};

/// Irradiance from an engine, with the engine's lumels.
struct Found {
    Lumels lumels;
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]
};

/// Relative to the mean irradiance, without the noise of the reference.
struct Deviation {
    double rmse = 0.0, bias = 0.0;
};

/// A room path-traced in two independent halves.
class Reference {
public:
    /// movable: names of objects that may move, so that they cut no lumel of what they stand on.
    Reference(const std::string& scene_path, const std::vector<std::string>& movable);
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    /// Throws std::runtime_error if the lumels are not those of the reference.
    Deviation of(const Found& found) const;

private:
    std::unique_ptr<SolveScene> world_;
    std::vector<glm::vec3> halves_[2];
    std::map<std::uint64_t, std::size_t> lumel_at_;  ///< by texel and side
};

}  // namespace lumel::test
