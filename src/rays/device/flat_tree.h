#pragma once
// A BVH of a scene's triangles as plain arrays, for traversal by shaders.

#include <vector>

#include "rays/cast/device_triangles.h"
#include "rays/device/device_caster.shared.h"

namespace lumel {

/// Nodes of two boxes; triangles by leaf.
struct FlatTree {
    std::vector<TreeNode> nodes;  ///< the root first
    std::vector<TreeTriangle> triangles;
};

/// Builds the tree by Embree, on all cores, with binned surface area heuristic. Boxes without
/// content are never entered. Throws Error{device} if Embree cannot (out of memory) or if a path
/// has more than kTreeDepth nodes.
FlatTree build_flat_tree(const DeviceTriangles::Mesh& mesh);

}  // namespace lumel
