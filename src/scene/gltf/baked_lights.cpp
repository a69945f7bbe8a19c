#include "scene/gltf/baked_lights.h"

#include <algorithm>
#include <iterator>

#include "scene/gltf/extras.h"

namespace lumel {
namespace {

constexpr const char* kLights[] = {"KHR_lights_punctual", "EXT_lights_ies",
                                   "EXT_lights_image_based"};
constexpr const char *kExtensions = "extensions", *kBaked = "lumel_baked_lights";

/// Moves lights from one member of an object to another. Returns true if there were any.
bool move_lights(Json& from, Json& into)
{
    bool any = false;
    for (const char* name : kLights) {
        const auto found = from.find(name);
        if (found == from.end())
            continue;
        into[name] = std::move(*found);
        from.erase(found);
        any = true;
    }
    return any;
}

bool put_away(Json& object)
{
    const auto extensions = object.find(kExtensions);
    if (extensions == object.end())
        return false;
    Json lights = Json::object();
    if (!move_lights(*extensions, lights))
        return false;
    if (extensions->empty())
        object.erase(kExtensions);
    extras_of(object)[kBaked] = std::move(lights);  // invalidates references into `object`
    return true;
}

/// The hidden lights of an object, or null.
const Json* put_away_from(const Json& object)
{
    const Json* lights = in_extras(object, kBaked);
    return lights && lights->is_object() ? lights : nullptr;
}

void bring_back(Json& object)
{
    if (!put_away_from(object))
        return;
    const auto extensions = object.find(kExtensions);
    if (extensions != object.end() && !extensions->is_object())
        return;
    Json lights = std::move(extras_of(object)[kBaked]);
    erase_from_extras(object, kBaked);
    move_lights(lights, object[kExtensions]);  // invalidates references into `object`
}

/// True if a program has changed the lists of lights since; the references of nodes are then
/// invalid.
bool is_outdated(Json& gltf)
{
    const Json* lists = put_away_from(gltf);
    const auto extensions = gltf.find(kExtensions);
    if (!lists)
        return true;
    if (extensions == gltf.end())
        return false;
    if (!extensions->is_object())
        return true;
    return std::any_of(std::begin(kLights), std::end(kLights), [&](const char* name) {
        return lists->contains(name) && extensions->contains(name);
    });
}

/// Calls visit(list) for the lists of objects, beside the root, that may have lights.
template <class Visit>
void for_lists(Json& gltf, const Visit& visit)
{
    for (const char* name : {"scenes", "nodes"}) {
        const auto list = gltf.find(name);
        if (list != gltf.end() && list->is_array())
            visit(*list, name);
    }
}

}  // namespace

std::size_t put_away_lights(Json& gltf)
{
    std::size_t lights = 0;
    for_lists(gltf, [&](Json& list, const std::string& name) {
        for (Json& object : list)
            if (put_away(object) && name == "nodes")
                ++lights;
    });
    put_away(gltf);
    return lights;
}

void bring_back_lights(Json& gltf)
{
    if (is_outdated(gltf))
        return;
    for_lists(gltf, [](Json& list, const std::string&) {
        for (Json& object : list)
            bring_back(object);
    });
    bring_back(gltf);
}

}  // namespace lumel
