#pragma once
// Results of lumel_c.h.

#include <memory>
#include <vector>

#include "api/c_scene.h"
#include "lumel/lumel.h"
#include "lumel/lumel_c.h"

namespace lumel::v0 {

/// A result, and the arrays that it points to.
struct CBaked {
    lumel_baked shown{};
    Baked baked;
    std::vector<lumel_map> directional;
    std::vector<std::vector<const char*>> members;  ///< [lamps]
    std::vector<lumel_lamp> lamps;
    std::vector<lumel_daylight_map> daylight_maps;
    std::vector<lumel_daylight_hour> hours;
    lumel_daylight_maps daylight{};
    std::vector<lumel_surface> surfaces;
    std::vector<lumel_page> pages;
    std::vector<const char*> notes;
};

/// scene: the one that was baked.
std::unique_ptr<CBaked> result_of(Baked&& baked, const lumel_scene& scene);

}  // namespace lumel::v0
