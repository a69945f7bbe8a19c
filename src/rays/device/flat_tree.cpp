#include "rays/device/flat_tree.h"

#include <array>
#include <limits>
#include <memory>
#include <string>

#include "base/core/error.h"
#include "rays/cast/embree.h"

namespace lumel {
namespace {

/// Triangles of a leaf, at most. More cost tests, fewer cost nodes.
constexpr unsigned kLeaf = 4;
constexpr std::size_t kPieceAlignment = 16;
constexpr float kEndless = std::numeric_limits<float>::infinity();

/// A node or leaf that Embree builds: a leaf if it has triangles, else a node.
struct TreePiece {
    unsigned count = 0;
    std::array<std::uint32_t, kLeaf> triangles{};
    std::array<TreePiece*, 2> children{};
    std::array<RTCBounds, 2> bounds{};
};

void* new_piece(RTCThreadLocalAllocator allocator)
{
    return new (rtcThreadLocalAlloc(allocator, sizeof(TreePiece), kPieceAlignment)) TreePiece;
}

void* make_node(RTCThreadLocalAllocator allocator, unsigned, void*)
{
    return new_piece(allocator);
}

void set_children(void* node, void** children, unsigned count, void*)
{
    for (unsigned k = 0; k < count; ++k)
        static_cast<TreePiece*>(node)->children[k] = static_cast<TreePiece*>(children[k]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*)
{
    for (unsigned k = 0; k < count; ++k)
        static_cast<TreePiece*>(node)->bounds[k] = *bounds[k];
}

void* make_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                std::size_t count, void*)
{
    auto* leaf = static_cast<TreePiece*>(new_piece(allocator));
    leaf->count = unsigned(count);
    for (std::size_t k = 0; k < count; ++k)
        leaf->triangles[k] = primitives[k].primID;
    return leaf;
}

std::vector<RTCBuildPrimitive> primitives_of(const DeviceTriangles::Mesh& mesh)
{
    std::vector<RTCBuildPrimitive> primitives(mesh.corners.size() / 3);
    for (std::uint32_t t = 0; t < primitives.size(); ++t) {
        const auto corner = [&](unsigned k) {
            return mesh.positions[mesh.corners[3 * std::size_t(t) + k]];
        };
        const glm::vec3 low = glm::min(corner(0), glm::min(corner(1), corner(2)));
        const glm::vec3 high = glm::max(corner(0), glm::max(corner(1), corner(2)));
        primitives[t] = {low.x, low.y, low.z, 0, high.x, high.y, high.z, t};
    }
    return primitives;
}

/// Copies the tree that Embree built, depth first.
class Flattened {
public:
    explicit Flattened(const DeviceTriangles::Mesh& mesh) : mesh_(mesh) {}

    FlatTree of(const TreePiece* root)
    {
        if (root && root->count == 0)
            add_node(*root, 1);
        else
            add_only_leaf(root);
        return std::move(tree_);
    }

private:
    /// A root has two children: the leaf twice. In an empty scene it holds a triangle that no ray
    /// meets, as it has no area.
    void add_only_leaf(const TreePiece* leaf)
    {
        const unsigned count = leaf ? leaf->count : 1;
        for (unsigned k = 0; k < count; ++k)
            if (leaf)
                add_triangle(leaf->triangles[k]);
            else
                tree_.triangles.emplace_back();
        const TreeBox all{glm::vec3(-kEndless), 0, glm::vec3(kEndless), count};
        tree_.nodes.push_back({all, all});
    }

    std::uint32_t add_node(const TreePiece& node, unsigned depth)
    {
        if (depth > kTreeDepth)
            throw Error(ErrorKind::device, "--rays tree",
                        "triangles lie too close together for its tree; use --rays host");
        const auto number = std::uint32_t(tree_.nodes.size());
        tree_.nodes.emplace_back();
        const TreeBox left = box(*node.children[0], node.bounds[0], depth);
        const TreeBox right = box(*node.children[1], node.bounds[1], depth);
        tree_.nodes[number] = {left, right};
        return number;
    }

    TreeBox box(const TreePiece& piece, const RTCBounds& bounds, unsigned depth)
    {
        const std::uint32_t first =
            piece.count == 0 ? add_node(piece, depth + 1) : std::uint32_t(tree_.triangles.size());
        for (unsigned k = 0; k < piece.count; ++k)
            add_triangle(piece.triangles[k]);
        return {{bounds.lower_x, bounds.lower_y, bounds.lower_z},
                first,
                {bounds.upper_x, bounds.upper_y, bounds.upper_z},
                piece.count};
    }

    void add_triangle(std::uint32_t number)
    {
        const auto corner = [&](unsigned k) {
            return mesh_.positions[mesh_.corners[3 * std::size_t(number) + k]];
        };
        tree_.triangles.push_back({corner(0), number, corner(1), 0, corner(2), 0});
    }

    const DeviceTriangles::Mesh& mesh_;
    FlatTree tree_;
};

template <auto release>
struct Released {
    template <class T>
    void operator()(T* object) const
    {
        release(object);
    }
};

}  // namespace

FlatTree build_flat_tree(const DeviceTriangles::Mesh& mesh)
{
    std::vector<RTCBuildPrimitive> primitives = primitives_of(mesh);
    if (primitives.empty())
        return Flattened(mesh).of(nullptr);
    const std::unique_ptr<RTCDeviceTy, Released<rtcReleaseDevice>> device(rtcNewDevice(nullptr));
    const std::unique_ptr<RTCBVHTy, Released<rtcReleaseBVH>> bvh(device ? rtcNewBVH(device.get())
                                                                        : nullptr);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = kTreeDepth;
    arguments.maxLeafSize = kLeaf;
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = make_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = make_leaf;
    const auto* root = static_cast<const TreePiece*>(bvh ? rtcBuildBVH(&arguments) : nullptr);
    if (!root)
        throw Error(ErrorKind::device, "--rays tree",
                    std::string("the tree of its triangles could not be built: ") +
                        (rtcGetDeviceError(device.get()) == RTC_ERROR_OUT_OF_MEMORY
                             ? "out of memory"
                             : "Embree failed; use --rays host"));
    return Flattened(mesh).of(root);
}

}  // namespace lumel
