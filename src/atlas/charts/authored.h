#pragma once
// Lightmap layouts from the file's TEXCOORD_1.

#include <string>
#include <vector>

#include "atlas/charts/layout.h"

namespace lumel {

/// Usability of a mesh's TEXCOORD_1 for a lightmap.
struct AuthoredReport {
    bool present = false;           ///< every primitive has the set
    double outside = 0.0;           ///< maximum distance outside 0…1
    double overlap = 0.0;           ///< share of the layout's area that overlaps itself
    bool overlap_is_least = false;  ///< `overlap` is a lower bound
    double collapsed = 0.0;         ///< share of the surface without area in the layout
    double area = 0.0;              ///< area of the layout; the unit square has 1

    bool valid() const;
    /// The reason why it is unusable, as the end of a sentence; empty if it is usable.
    std::string complaint() const;
};

AuthoredReport check_authored(const Mesh& mesh);

/// True if the layouts of all instances together lie in 0…1 without overlap: one lightmap for the
/// scene. `reports` [mesh].
bool is_scene_wide(const Scene& scene, const std::vector<AuthoredReport>& reports);

/// Layout from TEXCOORD_1: place = TEXCOORD_1, charts = connected parts.
Layout authored_layout(const Primitive& primitive);

}  // namespace lumel
