#include "scene/load/gltf_nodes.h"

#include <cmath>

namespace lumel {

namespace {

constexpr std::size_t kNone = SIZE_MAX;
/// Tolerance for unit quaternions, which are often written with few digits.
constexpr float kScaleTolerance = 0.01f;

/// Parents and children, verified to be a forest.
struct Hierarchy {
    std::vector<std::vector<std::size_t>> children;
    std::vector<std::size_t> parent;  ///< kNone: root
};

Hierarchy read_hierarchy(const JsonView& root)
{
    const std::size_t count = root.count("nodes");
    Hierarchy tree{std::vector<std::vector<std::size_t>>(count),
                   std::vector<std::size_t>(count, kNone)};
    root.each("nodes", [&](const JsonView& node, std::size_t i) {
        node.each("children", [&](const JsonView& view, std::size_t) {
            const std::size_t child = view.index(count, "nodes");
            if (tree.parent[child] != kNone)
                view.fail("node " + std::to_string(child) + " already is a child of node " +
                          std::to_string(tree.parent[child]));
            tree.parent[child] = i;
            tree.children[i].push_back(child);
        });
    });

    // Every node has at most one parent, so nodes without a path to a root form cycles.
    std::vector<bool> reached(count, false);
    std::vector<std::size_t> pending;
    for (std::size_t i = 0; i < count; ++i)
        if (tree.parent[i] == kNone)
            pending.push_back(i);
    while (!pending.empty()) {
        const std::size_t node = pending.back();
        pending.pop_back();
        reached[node] = true;
        pending.insert(pending.end(), tree.children[node].begin(), tree.children[node].end());
    }
    for (std::size_t i = 0; i < count; ++i)
        if (!reached[i])
            root.get("nodes").at(i).fail("is its own ancestor");
    return tree;
}

glm::dmat4 matrix_of(const JsonView& node)
{
    glm::mat4 matrix(1.0f);
    node.numbers("matrix", &matrix[0].x, 16);
    if (matrix[0].w != 0.0f || matrix[1].w != 0.0f || matrix[2].w != 0.0f || matrix[3].w != 1.0f)
        node.get("matrix").fail("is not affine: its last row must be 0 0 0 1");
    for (const char* key : {"translation", "rotation", "scale"})
        if (node.find(key))
            node.fail(std::string("has both a matrix and a ") + key);
    return matrix;
}

std::vector<std::size_t> scene_roots(const JsonView& root, const Hierarchy& tree)
{
    std::vector<std::size_t> roots;
    const auto scene = default_scene(root);
    if (!scene) {
        for (std::size_t i = 0; i < tree.parent.size(); ++i)
            if (tree.parent[i] == kNone)
                roots.push_back(i);
        return roots;
    }
    std::vector<bool> listed(tree.parent.size(), false);
    scene->each("nodes", [&](const JsonView& view, std::size_t) {
        const std::size_t node = view.index(tree.parent.size(), "nodes");
        if (tree.parent[node] != kNone)
            view.fail("node " + std::to_string(node) + " is not a root, but a child of node " +
                      std::to_string(tree.parent[node]));
        if (listed[node])
            view.fail("node " + std::to_string(node) + " is listed twice");
        listed[node] = true;
        roots.push_back(node);
    });
    return roots;
}

bool is_finite(const glm::dmat4& matrix)
{
    const glm::mat4 narrow(matrix);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(narrow[column][row]))
                return false;
    return true;
}

}  // namespace

std::optional<JsonView> default_scene(const JsonView& root)
{
    const auto chosen = root.find("scene");
    const std::size_t count = root.count("scenes");
    const std::size_t scene = chosen ? chosen->index(count, "scenes") : 0;
    return count == 0 ? std::nullopt : std::optional(root.get("scenes").at(scene));
}

glm::dquat rotation_of(const JsonView& object)
{
    glm::vec4 rotation(0.0f, 0.0f, 0.0f, 1.0f);
    object.numbers("rotation", &rotation.x, 4);
    if (!(std::abs(glm::length(rotation) - 1.0f) <= kScaleTolerance))
        object.get("rotation").fail("is not a unit quaternion");
    const glm::dvec4 unit = glm::normalize(glm::dvec4(rotation));
    return {unit.w, unit.x, unit.y, unit.z};
}

NodePlace read_place(const JsonView& node)
{
    NodePlace place;
    if (node.find("matrix")) {
        place.matrix = matrix_of(node);
        return place;
    }
    glm::vec3 translation(0.0f);
    glm::vec3 scale(1.0f);
    node.numbers("translation", &translation.x, 3);
    node.numbers("scale", &scale.x, 3);
    place.translation = translation;
    place.rotation = rotation_of(node);
    place.scale = scale;
    return place;
}

std::vector<int> parents_of(const JsonView& root)
{
    std::vector<int> parents;
    for (const std::size_t parent : read_hierarchy(root).parent)
        parents.push_back(parent == kNone ? -1 : int(parent));
    return parents;
}

std::vector<PlacedNode> place_nodes(const GltfDocument& document)
{
    const JsonView root = document.root();
    const Hierarchy tree = read_hierarchy(root);

    // Iterative: hierarchies may be thousands of levels deep.
    std::vector<glm::dmat4> world(tree.parent.size(), glm::dmat4(1.0));
    std::vector<bool> reached(tree.parent.size(), false);
    std::vector<std::size_t> pending = scene_roots(root, tree);
    while (!pending.empty()) {
        const std::size_t node = pending.back();
        pending.pop_back();
        const JsonView view = root.get("nodes").at(node);
        const std::size_t parent = tree.parent[node];
        world[node] =
            (parent == kNone ? glm::dmat4(1.0) : world[parent]) * to_matrix(read_place(view));
        if (!is_finite(world[node]))
            view.fail("its transform to the world is not finite");
        reached[node] = true;
        pending.insert(pending.end(), tree.children[node].begin(), tree.children[node].end());
    }

    std::vector<PlacedNode> placed;
    for (std::size_t i = 0; i < world.size(); ++i)
        if (reached[i])
            placed.push_back({i, world[i]});
    return placed;
}

}  // namespace lumel
