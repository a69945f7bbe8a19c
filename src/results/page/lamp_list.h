#pragma once
// lamps.json: the lamps whose light a bake has written apart.

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/json/json_view.h"
#include "results/record/bake_record.h"

namespace lumel {

inline constexpr std::size_t kMaxListedLamps = 64;

/// A lamp, or several that share a switch.
struct ListedLamp {
    std::string name;  ///< unique
    std::string kind;  ///< sky, sun, point, spot, directional, surface or group
    std::vector<std::string> members;
    glm::dvec3 color;             ///< of its light on the surfaces, linear, largest channel 1
    std::optional<double> error;  ///< estimated relative error of its map
    std::string map;              ///< path in the folder, without page and extension
};

/// Lamps of the document. pages: files per map. Throws Error{input} with the location of a member
/// that is missing, of another type or out of range, for a name given twice, and for a map outside
/// the folder.
std::vector<ListedLamp> lamps_of(const JsonView& document, int pages);

/// Path of a map in the folder without its end: ".exr", or "-0.exr" if each map has several pages.
/// Throws Error{input} if it has another end or leads out of the folder.
std::string map_path_of(const JsonView& view, int pages);

}  // namespace lumel
