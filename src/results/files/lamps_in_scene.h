#pragma once
// Maps of lamps in scene.glb.

#include <span>
#include <string>
#include <vector>

#include "atlas/packing/pages.h"
#include "base/json/json_file.h"
#include "results/files/glb_builder.h"

namespace lumel {

/// A lamp, for viewers that dim it.
struct SceneLamp {
    std::string name, kind;
    std::vector<std::string> members;  ///< names of the joined lamps, or its own
    glm::dvec3 color;                  ///< of its light on the surfaces, largest channel 1
    double error;                      ///< estimated relative error of its map
    const Image* map;                  ///< irradiance [lx], RGBA
};

/// Appends the maps of lamps at half the size. asset.extras.lumel.lamps names their `bufferView`:
/// gzip of the bytes of half_map() for each lamp of each page, pages first; `width` and `height` of
/// each; and the `list` of lamps, where `brightest` has the largest illuminance of each page [lx].
void add_lamps(GlbBuilder& builder, const Pages& pages, std::span<const SceneLamp> lamps);

}  // namespace lumel
