#include "results/page/lamp_list.h"

#include <algorithm>
#include <filesystem>
#include <limits>

namespace lumel {
namespace {

constexpr Named<const char*> kLampKinds[] = {{"sky", "sky"},
                                             {"sun", "sun"},
                                             {"point", "point"},
                                             {"spot", "spot"},
                                             {"directional", "directional"},
                                             {"surface", "surface"},
                                             {"group", "group"}};

glm::dvec3 lamp_color_of(const JsonView& view)
{
    if (view.as_array().json().size() != 3)
        view.fail("must be [r, g, b]");
    glm::dvec3 color(0.0);
    for (int c = 0; c < 3; ++c)
        color[c] = view.at(std::size_t(c)).number(0.0, 1.0);
    return color;
}

ListedLamp lamp_of(const JsonView& view, int pages)
{
    ListedLamp lamp{.name = view.get("name").string(),
                    .kind = named_by(view.get("kind"), kLampKinds),
                    .members = {},
                    .color = lamp_color_of(view.get("color")),
                    .error = {},
                    .map = map_path_of(view.get("map"), pages)};
    if (lamp.name.empty())
        view.get("name").fail("must not be empty");
    view.get("members").each(
        [&](const JsonView& member, std::size_t) { lamp.members.push_back(member.string()); });
    if (const auto error = view.find("error"))
        lamp.error = error->number(0.0, std::numeric_limits<double>::max());
    return lamp;
}

}  // namespace

std::string map_path_of(const JsonView& view, int pages)
{
    const std::string& path = view.string();
    const std::string end = pages > 1 ? "-0.exr" : ".exr";
    if (path.size() <= end.size() || !path.ends_with(end))
        view.fail("is " + lumel::quoted(path) + ", but must end with " + end);
    const std::filesystem::path parts(path);
    if (parts.is_absolute() || std::find(parts.begin(), parts.end(), "..") != parts.end())
        view.fail("is " + lumel::quoted(path) + ", but must be a file in the folder of the bake");
    return path.substr(0, path.size() - end.size());
}

std::vector<ListedLamp> lamps_of(const JsonView& document, int pages)
{
    std::vector<ListedLamp> lamps;
    const JsonView list = document.get("lamps");
    list.each([&](const JsonView& view, std::size_t) {
        ListedLamp lamp = lamp_of(view, pages);
        if (std::any_of(lamps.begin(), lamps.end(),
                        [&](const ListedLamp& other) { return other.name == lamp.name; }))
            view.get("name").fail("is the second lamp named " + lumel::quoted(lamp.name));
        lamps.push_back(std::move(lamp));
    });
    if (lamps.empty() || lamps.size() > kMaxListedLamps)
        list.fail("has " + std::to_string(lamps.size()) + " lamps, but must have 1 to " +
                  std::to_string(kMaxListedLamps));
    return lamps;
}

}  // namespace lumel
