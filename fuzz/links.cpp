#include "links/kept/links_file.h"
#include "memory_file.h"

namespace lumel::fuzz {

void read_links(Input input)
{
    const MemoryFile file(input);
    const StoredLinks kept = lumel::read_links(file.path());
    require(kept.links.size() == kept.lumels.size() * kept.rays, "every lumel has its links");
    for (const std::uint32_t link : kept.links)
        require(link < kept.ends(), "links end somewhere");
}

}  // namespace lumel::fuzz
