// Bakes of lumel_c.h: their settings, calls and files.

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/c_baked.h"
#include "api/c_calls.h"
#include "api/c_scene.h"

struct lumel_device {
    lumel::v0::Device device;
};

namespace lumel::v0 {
namespace {

thread_local std::string last_message;

const Baked& baked_of(const lumel_baked* baked)
{
    require(baked, "baked");
    require(baked->internal, "baked.internal");
    return static_cast<const CBaked*>(baked->internal)->baked;
}

[[noreturn]] void refuse_value(const char* setting)
{
    throw Error(ErrorKind::input, std::string("settings.") + setting + ": has an unknown value");
}

Sides sides_of(int sides)
{
    switch (sides) {
    case LUMEL_SIDES_AUTOMATIC:
        return Sides::automatic;
    case LUMEL_SIDES_BOTH:
        return Sides::both;
    case LUMEL_SIDES_BRIGHTER:
        return Sides::brighter;
    case LUMEL_SIDES_FRONT:
        return Sides::front;
    }
    refuse_value("sides");
}

Parts parts_of(int parts)
{
    switch (parts) {
    case LUMEL_ALL_LIGHT:
        return Parts::all;
    case LUMEL_DIRECT_LIGHT:
        return Parts::direct;
    case LUMEL_INDIRECT_LIGHT:
        return Parts::indirect;
    }
    refuse_value("parts");
}

Directional directional_of(int directional)
{
    switch (directional) {
    case LUMEL_NO_DIRECTIONS:
        return Directional::none;
    case LUMEL_SH1:
        return Directional::sh1;
    case LUMEL_SH2:
        return Directional::sh2;
    }
    refuse_value("directional");
}

AtlasSettings atlas_of(const lumel_settings& from)
{
    AtlasSettings atlas;
    const auto set = [](int& to, int given) {
        if (given != 0)
            to = given;
    };
    atlas.texels_per_metre = from.texels_per_metre;
    set(atlas.size, from.size);
    set(atlas.max_size, from.max_size);
    set(atlas.gutter, from.gutter);
    set(atlas.pages, from.pages);
    atlas.sides = sides_of(from.sides);
    atlas.coarse_afar = from.coarse_afar != 0;
    if (from.density_count > 0)
        require(from.densities, "settings.densities");
    for (std::uint32_t i = 0; i < from.density_count; ++i)
        atlas.densities.push_back(
            {text_of(from.densities[i].pattern), from.densities[i].texels_per_metre});
    return atlas;
}

BakeSettings settings_of(const lumel_settings& from)
{
    BakeSettings settings;
    settings.atlas = atlas_of(from);
    if (from.method)
        settings.method = from.method;
    for (const char* const* option = from.options; option && option[0]; option += 2) {
        require(option[1], std::string("settings.options: the value of ") + option[0]);
        settings.options[option[0]] = option[1];
    }
    settings.parts = parts_of(from.parts);
    settings.directional = directional_of(from.directional);
    settings.per_lamp = from.per_lamp != 0;
    if (from.group_count > 0)
        require(from.groups, "settings.groups");
    for (std::uint32_t i = 0; i < from.group_count; ++i)
        settings.groups.push_back({text_of(from.groups[i].name), text_of(from.groups[i].pattern)});
    settings.weather_file = text_of(from.weather_file);
    if (from.seed != 0)
        settings.seed = from.seed;
    if (from.error != 0.0)
        settings.error = from.error;
    settings.dark_error = from.dark_error;
    settings.eye_error = from.eye_error;
    settings.visible_noise = from.visible_noise;
    settings.seconds = from.seconds;
    settings.shots = from.shots;
    settings.max_memory = from.max_memory;
    return settings;
}

ProgressFunction progress_of(const lumel_settings& from)
{
    if (!from.progress)
        return {};
    return [tell = from.progress, user = from.user](const Progress& now) {
        const lumel_progress told{now.stage.c_str(), now.fraction, now.shots, now.error,
                                  now.seconds};
        return tell(&told, user) != 0;
    };
}

void read_probe(const Probe& from, lumel_probe& to)
{
    for (std::size_t i = 0; i < from.coefficients.size(); ++i)
        std::copy_n(from.coefficients[i].begin(), 3, to.coefficients[i]);
    to.noise = from.noise;
    to.inside = from.inside ? 1 : 0;
}

LightmapFormat format_of(int format)
{
    switch (format) {
    case LUMEL_KTX2:
        return LightmapFormat::ktx2;
    case LUMEL_RGB9E5:
        return LightmapFormat::rgb9e5;
    case LUMEL_PNG:
        return LightmapFormat::png;
    case LUMEL_NO_MAP:
        return LightmapFormat::none;
    }
    throw Error(ErrorKind::input, "format: has an unknown value");
}

}  // namespace

std::string in_c(std::string message)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kNames = {{
        {"BakeSettings::", "settings."},
        {"AtlasSettings::", "settings."},
        {"Daylight::", "daylight."},
        {"Device::Device", "lumel_open_device"},
        {"Scene::add_daylight", "lumel_add_daylight"},
        {"Parts::all", "LUMEL_ALL_LIGHT"},
        {"write_scene()", "lumel_write_scene()"},
        {"needs a Device", "needs a device"},
    }};
    for (const auto& [from, to] : kNames)
        for (std::size_t at = message.find(from); at != message.npos;
             at = message.find(from, at + to.size()))
            message.replace(at, from.size(), to);
    return message;
}

void keep_message(const char* sentence) noexcept
{
    try {
        last_message = in_c(sentence);
    } catch (...) {
        last_message.clear();
    }
}

}  // namespace lumel::v0

using namespace lumel::v0;

const char* lumel_message(void)
{
    return last_message.c_str();
}

int lumel_version(void)
{
    return version();
}

void lumel_on_warning(lumel_warning_function function, void* user)
{
    guarded([&] {
        if (!function)
            on_warning({});
        else
            on_warning(
                [=](const std::string& sentence) { function(in_c(sentence).c_str(), user); });
    });
}

lumel_result lumel_open_device(const char* pick, lumel_device** device)
{
    return guarded([&] {
        require(device, "device");
        *device = new lumel_device{Device(text_of(pick))};
    });
}

void lumel_close_device(lumel_device* device)
{
    delete device;
}

lumel_result lumel_bake(const lumel_device* device, const lumel_scene* scene,
                        const lumel_settings* settings, const lumel_baked** baked)
{
    return guarded([&] {
        require(scene, "scene");
        require(baked, "baked");
        const lumel_settings given = settings ? *settings : lumel_settings{};
        const BakeSettings wanted = settings_of(given);
        const ProgressFunction progress = progress_of(given);
        Baked found = device ? bake(device->device, scene->scene, wanted, progress)
                             : bake(scene->scene, wanted, progress);
        *baked = &result_of(std::move(found), *scene).release()->shown;
    });
}

void lumel_free_baked(const lumel_baked* baked)
{
    if (baked)
        delete static_cast<const CBaked*>(baked->internal);
}

lumel_result lumel_probes(const lumel_baked* baked, const float* places, uint32_t count,
                          uint32_t samples, lumel_probe* probes)
{
    return guarded([&] {
        if (count > 0) {
            require(places, "places");
            require(probes, "probes");
        }
        std::vector<Vec3> at(count);
        for (std::size_t i = 0; i < count; ++i)
            std::copy_n(places + 3 * i, 3, at[i].begin());
        const std::vector<Probe> found = samples == 0
                                             ? lumel::v0::probes(baked_of(baked), at)
                                             : lumel::v0::probes(baked_of(baked), at, samples);
        for (std::size_t i = 0; i < count; ++i)
            read_probe(found[i], probes[i]);
    });
}

lumel_result lumel_write_scene(const lumel_baked* baked, const char* path, int format)
{
    return guarded([&] {
        require(path, "path");
        write_scene(path, baked_of(baked), format_of(format));
    });
}

lumel_result lumel_write_baked_scene(const lumel_baked* baked, const char* path, int size)
{
    return guarded([&] {
        require(path, "path");
        if (size == 0)
            write_baked_scene(path, baked_of(baked));
        else
            write_baked_scene(path, baked_of(baked), size);
    });
}
