#pragma once
// Lamps whose light a solution keeps apart.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "atlas/packing/atlas.h"
#include "lights/sources.h"

namespace lumel {

/// Maximum number of lamps that are kept apart.
inline constexpr std::size_t kMaxLamps = 64;

/// Joins all lamps whose names fit a pattern to one.
struct LampGroup {
    std::string name;
    std::string pattern;  ///< as in fnmatch(3), of names as those of light_sources()
};

/// A lamp, or a group of lamps.
struct NamedLamp {
    std::string name;
    std::vector<std::string> members;  ///< names of the joined lamps, or the lamp's own
    std::string kind;                  ///< "sky", "sun", "point", "spot", "surface" or "group"
};

struct LampTable {
    std::vector<NamedLamp> all;
    std::vector<std::uint32_t> of_source;  ///< [LightSources::count()]
    std::uint32_t of_dim_sky = 0;          ///< of LightSources::dim_sky(); 0 without a sky
};

/// Lamps of a scene: those of light_sources(), joined by groups. Throws Error{input} if there is
/// none or there are more than kMaxLamps, for a group that fits no lamp, and for a lamp that two
/// groups fit.
LampTable find_lamps(const Scene& scene, const Lumels& lumels, const LightSources& sources,
                     std::span<const LampGroup> groups);

/// Lamps of a scene, joined as in a list: each of light_sources() is of the lamp that has its name
/// among its members. file: that has the list. Throws Error{input} if a source is in none.
LampTable find_lamps(const Scene& scene, const Lumels& lumels, const LightSources& sources,
                     std::vector<NamedLamp> listed, const std::string& file);

}  // namespace lumel
