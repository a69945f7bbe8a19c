// Uncovered texels get the light of their nearest covered neighbours, over the whole map, so that
// no mipmap level averages anything else.

#include <cstddef>

#include "atlas/finish/finish.h"
#include "atlas/finish/grow.h"

namespace lumel {

void dilate(Image& map)
{
    std::vector<TexelState> states(std::size_t(map.width) * std::size_t(map.height));
    for (std::size_t texel = 0; texel < states.size(); ++texel)
        states[texel] = map.values[texel * 4 + 3] > 0.0f ? TexelState::known : TexelState::wanted;
    grow(map, std::move(states), {});
}

}  // namespace lumel
