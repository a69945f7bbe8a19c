#include "api/c_baked.h"

#include <string>
#include <utility>

#include "api/c_calls.h"

namespace lumel::v0 {
namespace {

lumel_map view_of(const Map& map)
{
    return {map.width, map.height, map.rgba.data()};
}

/// Numbers of a primitive's vertices in its mesh.
void name_vertices(std::vector<Surface>& surfaces, const lumel_scene& scene)
{
    if (scene.vertices.empty())
        return;
    const std::vector<Instance> instances = scene.scene.instances();
    for (Surface& surface : surfaces) {
        const std::vector<std::uint32_t>& used =
            scene.vertices[instances[surface.instance].mesh][surface.primitive];
        for (std::uint32_t& vertex : surface.source_vertex)
            vertex = used[vertex];
    }
}

lumel_surface view_of(const Surface& surface)
{
    return {.instance = surface.instance,
            .primitive = surface.primitive,
            .back = surface.back ? 1 : 0,
            .vertex_count = std::uint32_t(surface.source_vertex.size()),
            .source_vertex = surface.source_vertex.data(),
            .lightmap = surface.lightmap.empty() ? nullptr : surface.lightmap.front().data(),
            .page = surface.page.empty() ? nullptr : surface.page.data(),
            .triangle_count = std::uint32_t(surface.indices.size() / 3),
            .indices = surface.indices.data(),
            .texels_per_metre = surface.texels_per_metre};
}

std::vector<const char*> views_of(const std::vector<std::string>& texts)
{
    std::vector<const char*> views;
    for (const std::string& text : texts)
        views.push_back(text.c_str());
    return views;
}

lumel_lamp view_of(const LampMap& lamp, const std::vector<const char*>& members)
{
    return {.name = lamp.name.c_str(),
            .kind = lamp.kind.c_str(),
            .member_count = std::uint32_t(members.size()),
            .members = members.data(),
            .map = view_of(lamp.map),
            .error = lamp.error,
            .color = {lamp.color[0], lamp.color[1], lamp.color[2]}};
}

lumel_daylight_hour view_of(const DaylightHour& hour)
{
    return {.hour = hour.hour.c_str(),
            .sun = {hour.sun[0], hour.sun[1], hour.sun[2]},
            .lux = hour.lux,
            .mean = hour.mean,
            .error = hour.error,
            .weights = hour.weights.data()};
}

void show_lamps(CBaked& result)
{
    for (const LampMap& lamp : result.baked.lamps) {
        result.members.push_back(views_of(lamp.members));
        result.lamps.push_back(view_of(lamp, result.members.back()));
    }
    result.shown.lamp_count = std::uint32_t(result.lamps.size());
    result.shown.lamps = result.lamps.data();
}

void show_daylight(CBaked& result)
{
    if (!result.baked.daylight)
        return;
    const DaylightMaps& from = *result.baked.daylight;
    for (const DaylightMap& one : from.maps)
        result.daylight_maps.push_back({.hour = one.hour.c_str(), .map = view_of(one.map)});
    for (const DaylightHour& hour : from.hours)
        result.hours.push_back(view_of(hour));
    result.daylight = {.place = from.place.c_str(),
                       .latitude = from.latitude,
                       .longitude = from.longitude,
                       .error = from.error,
                       .map_count = std::uint32_t(result.daylight_maps.size()),
                       .maps = result.daylight_maps.data(),
                       .hour_count = std::uint32_t(result.hours.size()),
                       .hours = result.hours.data()};
    result.shown.daylight = &result.daylight;
}

}  // namespace

std::unique_ptr<CBaked> result_of(Baked&& given, const lumel_scene& scene)
{
    auto result = std::make_unique<CBaked>();
    result->baked = std::move(given);
    Baked& baked = result->baked;
    name_vertices(baked.surfaces, scene);
    for (std::string& note : baked.notes)
        note = in_c(std::move(note));
    for (const Map& map : baked.directional)
        result->directional.push_back(view_of(map));
    for (const Surface& surface : baked.surfaces)
        result->surfaces.push_back(view_of(surface));
    for (const Page& page : baked.pages)
        result->pages.push_back({page.x, page.y, page.side});
    result->notes = views_of(baked.notes);
    result->shown = {.map = view_of(baked.map),
                     .directional_count = std::uint32_t(result->directional.size()),
                     .directional = result->directional.data(),
                     .lamp_count = 0,
                     .lamps = nullptr,
                     .daylight = nullptr,
                     .surface_count = std::uint32_t(result->surfaces.size()),
                     .surfaces = result->surfaces.data(),
                     .page_count = std::uint32_t(result->pages.size()),
                     .pages = result->pages.data(),
                     .note_count = std::uint32_t(result->notes.size()),
                     .notes = result->notes.data(),
                     .texels_per_metre = baked.texels_per_metre,
                     .error = baked.error,
                     .eye_error = baked.eye_error,
                     .visible_noise = baked.visible_noise,
                     .shots = baked.shots,
                     .seconds = baked.seconds,
                     .interrupted = baked.interrupted ? 1 : 0,
                     .internal = result.get()};
    show_lamps(*result);
    show_daylight(*result);
    return result;
}

}  // namespace lumel::v0
