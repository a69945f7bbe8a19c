#include "source_folder.h"

namespace lumel::support {

// The one file that the path is compiled into: all others are the same in any folder.
std::string source_path(const std::string& name)
{
    return LUMEL_SOURCE_DIR "/" + name;
}

std::string data_path(const std::string& name)
{
    return LUMEL_SOURCE_DIR "/../shared/data/" + name;
}

}  // namespace lumel::support
