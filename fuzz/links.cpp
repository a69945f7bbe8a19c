#include "links/kept/links_file.h"
#include "memory_file.h"

namespace lumel::fuzz {

void read_links(Input input)
{
    const MemoryFile file(input);
    const StoredLinks kept = lumel::read_links(file.path());
    const std::uint32_t numbers = kept.numbers().count();
    for (const StoredLinks::Round& round : kept.rounds)
        for (std::size_t k = 0; k < kSolutions; ++k) {
            require(round.ends[k].size() == first_rays(round.rays[k]).back(),
                    "every lumel has its links");
            for (const LinkEnd end : round.ends[k])
                require(end.number() < numbers, "links end somewhere");
        }
}

}  // namespace lumel::fuzz
