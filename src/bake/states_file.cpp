#include "bake/states_file.h"

#include <algorithm>
#include <string_view>

#include "json/json_file.h"

namespace lumel {
namespace {

/// So long that an ending and a temporary name still fit into what file systems allow [bytes].
constexpr std::size_t kLongestName = 200;

/// True for names that every file system takes, and that stay in their folder.
bool names_a_file(const std::string& name)
{
    constexpr std::string_view kForbidden = "/\\:*?\"<>|";
    return !name.empty() && name.size() <= kLongestName && name.front() != '.' &&
           std::none_of(name.begin(), name.end(), [&](char letter) {
               const auto code = static_cast<unsigned char>(letter);
               return code < 0x20 || code == 0x7f || kForbidden.find(letter) != kForbidden.npos;
           });
}

void allow_only(const JsonView& object, std::initializer_list<std::string_view> members)
{
    for (const auto& [key, value] : object.as_object().json().items())
        if (std::find(members.begin(), members.end(), key) == members.end())
            object.fail("has an unknown member " + quoted(key));
}

glm::vec3 factor_of(const JsonView& view)
{
    glm::vec3 factor(0.0f);
    if (view.json().is_array()) {
        if (view.json().size() != 3)
            view.fail("must be a number or [r, g, b]");
        for (int c = 0; c < 3; ++c)
            factor[c] = view.at(std::size_t(c)).number();
    } else {
        factor = glm::vec3(view.number());
    }
    if (glm::any(glm::lessThan(factor, glm::vec3(0.0f))))
        view.fail("must not be below 0");
    return factor;
}

NamedState state_of(const JsonView& view)
{
    allow_only(view, {"name", "others", "lights"});
    NamedState state{.name = view.get("name").string()};
    if (!names_a_file(state.name))
        view.get("name").fail(lumel::quoted(state.name) + " cannot be the name of a file");
    if (const auto others = view.find("others"))
        state.light.others = factor_of(*others);
    if (const auto lights = view.find("lights"))
        for (const auto& [name, value] : lights->as_object().json().items())
            state.light.lights[name] = factor_of(lights->get(name.c_str()));
    return state;
}

}  // namespace

std::vector<NamedState> read_states(const std::string& path)
{
    const Json json = read_json(path);
    const JsonView root(path, json);
    allow_only(root, {"states"});
    std::vector<NamedState> states;
    root.get("states").each([&](const JsonView& view, std::size_t) {
        NamedState state = state_of(view);
        if (std::any_of(states.begin(), states.end(),
                        [&](const NamedState& other) { return other.name == state.name; }))
            view.fail("is the second state named " + lumel::quoted(state.name));
        states.push_back(std::move(state));
    });
    if (states.empty())
        root.get("states").fail("has no state");
    return states;
}

}  // namespace lumel
