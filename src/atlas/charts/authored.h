#pragma once
// Lightmap layouts that come with the file, in TEXCOORD_1.

#include <string>
#include <vector>

#include "atlas/charts/layout.h"

namespace lumel {

/// Why a mesh's TEXCOORD_1 can or cannot hold a lightmap.
struct AuthoredReport {
    bool present = false;           ///< every primitive has the set
    double outside = 0.0;           ///< how far it leaves 0…1
    double overlap = 0.0;           ///< share of its area that lies on other parts of itself
    bool overlap_is_least = false;  ///< the true overlap is at least that
    double collapsed = 0.0;         ///< share of the mesh's surface that has no area in the layout
    double area = 0.0;              ///< of the layout, of the unit square 1

    bool valid() const;
    /// What is wrong, as the end of a sentence; empty if nothing is.
    std::string complaint() const;
};

AuthoredReport check_authored(const Mesh& mesh);

/// True if the layouts of all instances together lie in 0…1 without overlap: one lightmap for
/// the whole scene. `reports` [mesh].
bool is_scene_wide(const Scene& scene, const std::vector<AuthoredReport>& reports);

/// A primitive as its TEXCOORD_1 has it: place = TEXCOORD_1, charts = connected parts.
Layout authored_layout(const Primitive& primitive);

}  // namespace lumel
