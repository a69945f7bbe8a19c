#include "jobs/edit/solution_file.h"
#include "memory_file.h"

namespace lumel::fuzz {

void read_solution(Input input)
{
    const MemoryFile file(input);
    const StoredSolution solution = lumel::read_solution(file.path());
    const std::size_t texels = std::size_t(solution.side) * std::size_t(solution.side);
    require(solution.front.size() == texels && solution.back.size() == texels &&
                solution.open.size() == texels && solution.charts.of_texel.size() == texels,
            "all layers are as large as the atlas");
}

}  // namespace lumel::fuzz
