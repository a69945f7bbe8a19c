#include "finish/finish.h"

namespace lumel {

Image finish_map(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<const glm::vec3> values)
{
    Image map = to_map(lumels, values);
    fill_buried(map, lumels);
    dilate(map);
    match_seams(map, scene, atlas, lumels);
    return map;
}

}  // namespace lumel
