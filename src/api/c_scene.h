#pragma once

#include <cstdint>
#include <vector>

#include "lumel/lumel.h"
#include "lumel/lumel_c.h"

namespace lumel::v0 {

/// A scene made of C arrays: its meshes are primitives, one for each material.
struct CContent {
    SceneContent content;
    /// [mesh][primitive] the mesh's vertices that the primitive uses, in its order.
    std::vector<std::vector<std::vector<std::uint32_t>>> vertices;
};

/// Copies the arrays; checks pointers, sizes and indices. Throws Error{input}.
CContent content_of(const lumel_content& from);

}  // namespace lumel::v0

struct lumel_scene {
    lumel::v0::Scene scene;
    /// As in CContent; empty for scenes from files.
    std::vector<std::vector<std::vector<std::uint32_t>>> vertices;
};
