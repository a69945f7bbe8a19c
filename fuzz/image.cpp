#include "readers.h"
#include "scene/load/gltf_image.h"

namespace lumel::fuzz {

void read_image(Input input)
{
    const Texture texture = decode_image({input.begin(), input.end()}, "image");
    require(texture.rgba.size() == std::size_t(texture.width) * std::size_t(texture.height) * 4,
            "an image has all its pixels");
}

void read_hdr(Input input)
{
    const Image image = decode_hdr({input.begin(), input.end()}, "sky.hdr");
    require(image.values.size() ==
                std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels),
            "a sky has all its pixels");
}

}  // namespace lumel::fuzz
