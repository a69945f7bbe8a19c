#include "results/files/root_node.h"

#include <cstddef>
#include <utility>

namespace lumel {

void add_root(Json& gltf, Json node, const glm::dmat4& world)
{
    if (world != glm::dmat4(1.0))
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                node["matrix"].push_back(world[column][row]);
    const std::size_t number = gltf["nodes"].size();
    gltf["nodes"].push_back(std::move(node));
    if (const auto scenes = gltf.find("scenes"); scenes != gltf.end() && !scenes->empty())
        (*scenes)[gltf.value("scene", std::size_t(0))]["nodes"].push_back(number);
}

}  // namespace lumel
