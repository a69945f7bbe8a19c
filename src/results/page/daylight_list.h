#pragma once
// daylight.json: maps of daylight, and the weights that add them up to any hour of the year.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/json/json_view.h"

namespace lumel {

inline constexpr std::size_t kMaxDaylightMaps = 48;

/// An hour with light. Its illuminance without direct sun is the weighted sum of the maps.
struct ListedHour {
    int index;                   ///< 24 × day + hour of a leap year, both from 0, standard time
    glm::dvec3 sun;              ///< unit direction to the sun in the middle of the hour
    double lux;                  ///< by direct sun on a plane that faces it [lx]
    double mean;                 ///< of all surfaces, without direct sun [lx]
    std::vector<float> weights;  ///< [maps], signed
};

struct ListedDaylight {
    std::string place;
    double latitude, longitude;     ///< [degrees]
    double error;                   ///< relative, of the sums of maps
    std::vector<std::string> maps;  ///< paths in the folder, without page and extension
    std::vector<ListedHour> hours;  ///< by index
};

/// pages: files per map. Throws Error{input} with the location of a member that is missing, of
/// another type or out of range, for hours out of order, and for a map outside the folder.
ListedDaylight daylight_of(const JsonView& document, int pages);

}  // namespace lumel
