#include "memory_file.h"
#include "methods/matrix/matrix_file.h"

namespace lumel::fuzz {

void read_matrix(Input input)
{
    const MemoryFile file(input);
    const Relightable light = read_relightable(file.path());
    for (const SourceLight& source : light.sources)
        require(source.direct.size() == light.size(), "a source lights every lumel");
}

}  // namespace lumel::fuzz
