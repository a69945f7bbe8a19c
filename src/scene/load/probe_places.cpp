#include "scene/load/probe_places.h"

#include "scene/gltf/extras.h"
#include "scene/load/gltf_nodes.h"

namespace lumel {

std::vector<ProbePlace> probe_places(const std::string& path)
{
    const GltfDocument document = load_gltf_document(path);
    std::vector<ProbePlace> places;
    for (const PlacedNode& placed : place_nodes(document)) {
        const JsonView node = document.root().get("nodes").at(placed.node);
        if (is_probe_in_extras(node))
            places.push_back({node.string_or("name", ""), glm::dvec3(placed.world[3])});
    }
    return places;
}

}  // namespace lumel
