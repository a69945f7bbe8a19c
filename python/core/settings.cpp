#include "settings.h"

#include "arguments.h"

namespace lumel_python {
namespace {

/// Removes a setting; None if it is not there.
Argument removed(py::dict& settings, const char* name)
{
    return {settings.attr("pop")(name, py::none()), name};
}

/// Removes a setting from `settings` into `to`, which stays as it is for None.
template <class Value>
void take(py::dict& settings, const char* name, Value& to)
{
    if (const Argument given = removed(settings, name); !given.value.is_none())
        read(given, to);
}

template <class Value>
void take_word(py::dict& settings, const char* name, Value& to,
               std::initializer_list<std::pair<const char*, Value>> words)
{
    if (const Argument given = removed(settings, name); !given.value.is_none())
        to = word_of<Value>(given, words);
}

/// Removes a mapping and passes its entries to `add`, in their order.
template <class Value, class Add>
void take_entries(py::dict& settings, const char* name, const Add& add)
{
    const Argument given = removed(settings, name);
    if (given.value.is_none())
        return;
    if (!py::hasattr(given.value, "keys"))
        refuse_type(given, "a mapping");
    for (const auto& [key, value] : py::dict(given.value)) {
        const Argument word{py::reinterpret_borrow<py::object>(key), "a key of " + given.place};
        const Argument entry{py::reinterpret_borrow<py::object>(value),
                             given.place + "[" + std::string(py::repr(key)) + "]"};
        add(value_of<std::string>(word), value_of<Value>(entry));
    }
}

lumel::AtlasSettings take_atlas(py::dict& settings)
{
    using lumel::Sides;
    lumel::AtlasSettings atlas;
    take(settings, "texels_per_metre", atlas.texels_per_metre);
    take(settings, "size", atlas.size);
    take(settings, "max_size", atlas.max_size);
    take(settings, "gutter", atlas.gutter);
    take(settings, "pages", atlas.pages);
    take_word<Sides>(settings, "sides", atlas.sides,
                     {{"automatic", Sides::automatic},
                      {"both", Sides::both},
                      {"brighter", Sides::brighter},
                      {"front", Sides::front}});
    take(settings, "coarse_afar", atlas.coarse_afar);
    take_entries<float>(settings, "densities", [&](std::string pattern, float texels_per_metre) {
        atlas.densities.push_back({std::move(pattern), texels_per_metre});
    });
    return atlas;
}

void take_movers(py::dict& settings, std::vector<std::uint32_t>& to)
{
    if (const Argument movers = removed(settings, "movers"); !movers.value.is_none())
        to = all_of(movers, &value_of<std::uint32_t>);
}

/// Throws TypeError if settings are left.
void refuse_rest(const py::dict& settings, const char* function)
{
    for (const auto& [name, value] : settings)
        throw py::type_error(std::string(function) + "() has no setting \"" +
                             name.cast<std::string>() + "\"");
}

}  // namespace

lumel::BakeSettings bake_settings(const py::kwargs& given)
{
    using lumel::Directional;
    using lumel::Parts;
    py::dict settings(given);
    lumel::BakeSettings bake;
    bake.atlas = take_atlas(settings);
    take(settings, "method", bake.method);
    take_entries<std::string>(settings, "options", [&](std::string name, std::string value) {
        bake.options[std::move(name)] = std::move(value);
    });
    take_word<Parts>(
        settings, "parts", bake.parts,
        {{"all", Parts::all}, {"direct", Parts::direct}, {"indirect", Parts::indirect}});
    take_word<Directional>(
        settings, "directional", bake.directional,
        {{"none", Directional::none}, {"sh1", Directional::sh1}, {"sh2", Directional::sh2}});
    take(settings, "per_lamp", bake.per_lamp);
    take_entries<std::string>(settings, "groups", [&](std::string name, std::string pattern) {
        bake.groups.push_back({std::move(name), std::move(pattern)});
    });
    if (const Argument file = removed(settings, "weather_file"); !file.value.is_none())
        bake.weather_file = path_of(file);
    take(settings, "seed", bake.seed);
    take(settings, "error", bake.error);
    take(settings, "dark_error", bake.dark_error);
    take(settings, "eye_error", bake.eye_error);
    take(settings, "visible_noise", bake.visible_noise);
    take(settings, "seconds", bake.seconds);
    take(settings, "shots", bake.shots);
    take(settings, "max_memory", bake.max_memory);
    refuse_rest(settings, "bake");
    return bake;
}

lumel::LiveSettings live_settings(const py::kwargs& given)
{
    using lumel::Redistribution;
    py::dict settings(given);
    lumel::LiveSettings live;
    live.atlas = take_atlas(settings);
    take_movers(settings, live.movers);
    take_word<Redistribution>(
        settings, "redistribution", live.redistribution,
        {{"incremental", Redistribution::incremental}, {"cross", Redistribution::cross}});
    take(settings, "seed", live.seed);
    take(settings, "residual", live.residual);
    refuse_rest(settings, "LiveScene");
    return live;
}

lumel::LiveLinksSettings live_links_settings(const py::kwargs& given)
{
    py::dict settings(given);
    lumel::LiveLinksSettings live;
    live.atlas = take_atlas(settings);
    take_movers(settings, live.movers);
    take(settings, "rays", live.rays);
    take(settings, "filter", live.filter);
    take(settings, "seed", live.seed);
    take(settings, "residual", live.residual);
    refuse_rest(settings, "LiveLinks");
    return live;
}

}  // namespace lumel_python
