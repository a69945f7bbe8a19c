#include <algorithm>

#include "base/core/error.h"
#include "scene/values/scene.h"

namespace lumel {

std::uint32_t find_instance(const Scene& scene, const std::string& name)
{
    const auto found =
        std::find_if(scene.instances.begin(), scene.instances.end(),
                     [&](const Instance& instance) { return instance.name == name; });
    if (found == scene.instances.end())
        throw Error(ErrorKind::input, scene.path, "has no instance named \"" + name + "\"");
    return std::uint32_t(found - scene.instances.begin());
}

}  // namespace lumel
