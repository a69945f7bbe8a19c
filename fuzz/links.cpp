#include "links/kept/links_file.h"
#include "memory_file.h"

namespace lumel::fuzz {

void read_links(Input input)
{
    const MemoryFile file(input);
    const StoredLinks kept = lumel::read_links(file.path());
    const std::uint32_t numbers = kept.numbers().count();
    for (const StoredLinks::Round& round : kept.rounds)
        for (const std::vector<LinkEnd>& ends : round.ends) {
            require(ends.size() == first_rays(round.rays).back(), "every lumel has its links");
            for (const LinkEnd end : ends)
                require(end.number() < numbers, "links end somewhere");
        }
}

}  // namespace lumel::fuzz
