#include "scene/baked_lights.h"

namespace lumel {
namespace {

constexpr const char* kLights[] = {"KHR_lights_punctual", "EXT_lights_ies",
                                   "EXT_lights_image_based"};
constexpr const char *kExtensions = "extensions", *kExtras = "extras",
                     *kBaked = "lumel_baked_lights";

/// Moves lights from one member of an object to another. Returns if there were any.
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
    Json& extras = object[kExtras];  // moves all that is in `object`
    if (!extras.is_null() && !extras.is_object())
        extras = Json{{"value", std::move(extras)}};
    extras[kBaked] = std::move(lights);
    return true;
}

void bring_back(Json& object)
{
    if (!object.is_object())
        return;
    const auto extras = object.find(kExtras);
    if (extras == object.end() || !extras->is_object())
        return;
    const auto found = extras->find(kBaked);
    if (found == extras->end() || !found->is_object())
        return;
    Json lights = std::move(*found);
    extras->erase(found);
    if (extras->empty())
        object.erase(extras);
    move_lights(lights, object[kExtensions]);  // moves all that is in `object`
}

/// Calls visit(list) for the lists of objects that lights can be in, beside the root.
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
    for_lists(gltf, [](Json& list, const std::string&) {
        for (Json& object : list)
            bring_back(object);
    });
    bring_back(gltf);
}

}  // namespace lumel
