#include "base/images/image_files.h"
#include "memory_file.h"

namespace lumel::fuzz {

void read_exr(Input input)
{
    const MemoryFile file(input);
    const Image image = lumel::read_exr(file.path());
    require(image.values.size() == std::size_t(image.width) * std::size_t(image.height) * 4,
            "an image has all its texels");
}

}  // namespace lumel::fuzz
