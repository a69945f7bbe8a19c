#include "lights/lamps.h"

#include <algorithm>
#include <optional>
#include <set>

#include <fnmatch.h>

#include <fmt/format.h>

#include "base/core/error.h"
#include "lights/light_sources.h"

namespace lumel {
namespace {

constexpr const char* kGroupKind = "group";

const char* kind_of(const PunctualLight& light)
{
    switch (light.kind) {
    case PunctualLight::Kind::directional:
        return "sun";
    case PunctualLight::Kind::point:
        return "point";
    case PunctualLight::Kind::spot:
        return "spot";
    }
    return "";
}

std::string kind_of(const Scene& scene, const LightSource& source)
{
    if (source.sky)
        return "sky";
    return source.lights.empty() ? "surface" : kind_of(scene.lights[source.lights.front()]);
}

/// All sources by name, also those that no lumel shows.
std::vector<LightSource> all_sources(const Scene& scene, const Lumels& lumels,
                                     const LightSources& sources)
{
    const std::vector<std::uint32_t> shown = shining_instances(lumels);
    std::set<std::uint32_t> instances(shown.begin(), shown.end());
    for (std::size_t s = 0; s < sources.count(); ++s)
        if (const LightSources::SourceInfo info = sources.origin(s);
            info.part == LightSources::Part::material)
            instances.insert(info.instance);
    return light_sources(scene, {instances.begin(), instances.end()});
}

bool fits(const LightSource& source, const LampGroup& group)
{
    const auto matches = [&](const std::string& name) {
        return fnmatch(group.pattern.c_str(), name.c_str(), 0) == 0;
    };
    return matches(source.name) || std::ranges::any_of(source.materials, matches);
}

/// Index of the group that a source belongs to.
std::optional<std::size_t> group_of(const LightSource& source, std::span<const LampGroup> groups)
{
    std::optional<std::size_t> found;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!fits(source, groups[g]) || (found && groups[*found].name == groups[g].name))
            continue;
        if (found)
            throw Error(ErrorKind::input, "--group",
                        fmt::format("puts the lamp \"{}\" into two groups, \"{}\" and \"{}\"",
                                    source.name, groups[*found].name, groups[g].name));
        found = g;
    }
    return found;
}

std::string quoted_names(const std::vector<LightSource>& sources)
{
    std::string names;
    for (const LightSource& source : sources)
        names += (names.empty() ? "\"" : ", \"") + source.name + "\"";
    return names;
}

void check_groups(const std::vector<LightSource>& sources, std::span<const LampGroup> groups)
{
    for (const LampGroup& group : groups) {
        if (group.name.empty())
            throw Error(ErrorKind::input, "--group", "needs a name for " + group.pattern);
        if (std::ranges::none_of(sources, [&](const LightSource& one) { return fits(one, group); }))
            throw Error(ErrorKind::input, "--group " + group.name + "=" + group.pattern,
                        "fits no lamp; the scene has " + quoted_names(sources));
    }
}

/// [sources] Index of the lamp of each.
std::vector<std::uint32_t> join(const Scene& scene, const std::vector<LightSource>& sources,
                                std::span<const LampGroup> groups, std::vector<NamedLamp>& lamps)
{
    std::vector<std::uint32_t> lamp_of;
    for (const LightSource& source : sources) {
        const std::optional<std::size_t> group = group_of(source, groups);
        const std::string name = group ? groups[*group].name : source.name;
        auto lamp = std::ranges::find(lamps, name, &NamedLamp::name);
        if (lamp != lamps.end() && !(group && lamp->kind == kGroupKind))
            throw Error(ErrorKind::input, "--group " + name,
                        "has the name of a lamp that is not in the group; choose another name");
        if (lamp == lamps.end())
            lamp = lamps.insert(
                lamps.end(), {.name = name, .kind = group ? kGroupKind : kind_of(scene, source)});
        lamp->members.push_back(source.name);
        lamp_of.push_back(std::uint32_t(lamp - lamps.begin()));
    }
    return lamp_of;
}

/// Sets the lamp of each source that is sampled. all: by name; lamp_of [all].
void assign_sources(const LightSources& sources, const std::vector<LightSource>& all,
                    const std::vector<std::uint32_t>& lamp_of, LampTable& lamps)
{
    for (std::size_t s = 0; s < sources.count(); ++s) {
        const LightSources::SourceInfo info = sources.origin(s);
        const auto is_of = [&](const LightSource& one) {
            switch (info.part) {
            case LightSources::Part::sky:
                return one.sky;
            case LightSources::Part::light:
                return std::ranges::find(one.lights, info.index) != one.lights.end();
            case LightSources::Part::material:
                return std::ranges::find(one.instances, info.instance) != one.instances.end();
            }
            return false;
        };
        const auto owner = std::ranges::find_if(all, is_of);
        lamps.of_source.push_back(owner != all.end() ? lamp_of[std::size_t(owner - all.begin())]
                                                     : 0u);
    }
    const auto sky = std::ranges::find_if(all, &LightSource::sky);
    if (sky != all.end())
        lamps.of_dim_sky = lamp_of[std::size_t(sky - all.begin())];
}

}  // namespace

LampTable find_lamps(const Scene& scene, const Lumels& lumels, const LightSources& sources,
                     std::span<const LampGroup> groups)
{
    const std::vector<LightSource> all = all_sources(scene, lumels, sources);
    if (all.empty())
        throw Error(ErrorKind::input, scene.path, "has no lamp whose light can be kept apart");
    check_groups(all, groups);
    LampTable lamps;
    const std::vector<std::uint32_t> lamp_of = join(scene, all, groups, lamps.all);
    if (lamps.all.size() > kMaxLamps)
        throw Error(ErrorKind::input, scene.path,
                    fmt::format("has {} lamps, and at most {} can be kept apart; join some by "
                                "--group NAME=PATTERN",
                                lamps.all.size(), kMaxLamps));
    assign_sources(sources, all, lamp_of, lamps);
    return lamps;
}

LampTable find_lamps(const Scene& scene, const Lumels& lumels, const LightSources& sources,
                     std::vector<NamedLamp> listed, const std::string& file)
{
    const std::vector<LightSource> all = all_sources(scene, lumels, sources);
    std::vector<std::uint32_t> lamp_of;
    for (const LightSource& source : all) {
        const auto lamp = std::ranges::find_if(listed, [&](const NamedLamp& one) {
            return std::ranges::find(one.members, source.name) != one.members.end();
        });
        if (lamp == listed.end())
            throw Error(ErrorKind::input, file, "has no lamp \"" + source.name + "\" of the scene");
        lamp_of.push_back(std::uint32_t(lamp - listed.begin()));
    }
    LampTable lamps{.all = std::move(listed)};
    assign_sources(sources, all, lamp_of, lamps);
    return lamps;
}

}  // namespace lumel
