#include "scene/gltf/baked_probes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/json/json_view.h"
#include "scene/gltf/extras.h"

namespace lumel {
namespace {

constexpr const char *kOwn = "lumel", *kMark = "light_probes";
constexpr const char *kNodes = "nodes", *kChildren = "children", *kScenes = "scenes";

bool is_group(const Json& node)
{
    const Json::json_pointer mark(std::string("/") + kExtras + "/" + kOwn + "/" + kMark);
    return node.is_object() && node.contains(mark) && node[mark] == true;
}

bool is_index(const Json& value, std::size_t index)
{
    return whole_number(value) == std::int64_t(index);
}

/// True if all nodes after a group are its children.
bool ends_with(const Json& nodes, std::size_t group)
{
    const auto children = nodes[group].find(kChildren);
    if (children == nodes[group].end() || !children->is_array() ||
        children->size() != nodes.size() - group - 1)
        return false;
    for (std::size_t i = 0; i < children->size(); ++i)
        if (!is_index((*children)[i], group + 1 + i))
            return false;
    return true;
}

}  // namespace

void add_light_probes(Json& gltf, Json probes)
{
    const auto scenes = gltf.find(kScenes);
    if (probes.empty() || scenes == gltf.end() || scenes->empty())
        return;
    Json& nodes = gltf[kNodes];
    const std::size_t group = nodes.size();
    Json children = Json::array();
    for (std::size_t i = 0; i < probes.size(); ++i)
        children.push_back(group + 1 + i);
    nodes.push_back({{"name", "light probes"},
                     {kChildren, std::move(children)},
                     {kExtras, {{kOwn, {{kMark, true}}}}}});
    for (Json& probe : probes)
        nodes.push_back(std::move(probe));
    (*scenes)[gltf.value("scene", std::size_t(0))][kNodes].push_back(group);
}

void drop_light_probes(Json& gltf)
{
    const auto nodes = gltf.find(kNodes);
    if (nodes == gltf.end() || !nodes->is_array())
        return;
    const auto found = std::find_if(nodes->begin(), nodes->end(), is_group);
    const auto group = std::size_t(found - nodes->begin());
    if (found == nodes->end() || !ends_with(*nodes, group))
        return;
    nodes->erase(found, nodes->end());
    const auto scenes = gltf.find(kScenes);
    if (scenes == gltf.end() || !scenes->is_array())
        return;
    for (Json& scene : *scenes) {
        if (!scene.is_object() || !scene.contains(kNodes) || !scene[kNodes].is_array())
            continue;
        Json kept = Json::array();
        for (Json& node : scene[kNodes])
            if (!is_index(node, group))
                kept.push_back(std::move(node));
        scene[kNodes] = std::move(kept);
    }
}

}  // namespace lumel
