#include "base/json/version.h"

#include <nlohmann/json.hpp>

namespace lumel {

std::string json_library_version()
{
    return nlohmann::json::meta()["version"]["string"];
}

}  // namespace lumel
