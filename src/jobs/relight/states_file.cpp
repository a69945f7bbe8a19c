#include "jobs/relight/states_file.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/core/error.h"
#include "base/json/json_file.h"
#include "scene/sky/sun.h"

namespace lumel {
namespace {

/// Leaves room for an extension and a temporary name within file system limits [bytes].
constexpr std::size_t kLongestName = 200;
constexpr double kStraightUp = 90.0;  // [degrees]

/// True for names that are valid in every file system and stay in their folder.
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

glm::dvec3 point_of(const JsonView& view)
{
    if (!view.json().is_array() || view.json().size() != 3)
        view.fail("must be [x, y, z]");
    return {view.at(0).number(), view.at(1).number(), view.at(2).number()};
}

/// Adds "azimuth" and "elevation" of a source, or "direction".
void add_direction_to(LampPlace& place, const JsonView& view)
{
    const auto direction = view.find("direction"), azimuth = view.find("azimuth"),
               elevation = view.find("elevation");
    if (!azimuth && !elevation) {
        if (direction)
            place.direction.emplace(point_of(*direction));
        return;
    }
    if (direction)
        view.fail("has a direction twice: leave out \"direction\", or the angles");
    const double up = view.get("elevation").number();
    if (std::abs(up) > kStraightUp)
        view.get("elevation").fail("must lie between -90 and 90 degrees");
    place.direction.emplace(
        -direction_of({glm::radians(view.get("azimuth").number()), glm::radians(up)}));
}

/// Adds a factor, or an object with changes of a light.
void add_light_to(LightState& state, const std::string& name, const JsonView& view)
{
    if (!view.json().is_object()) {
        state.lights[name] = factor_of(view);
        return;
    }
    allow_only(view, {"factor", "position", "direction", "azimuth", "elevation", "turn"});
    const auto factor = view.find("factor");
    state.lights[name] = factor ? factor_of(*factor) : glm::vec3(1.0f);
    LampPlace place;
    add_direction_to(place, view);
    if (const auto position = view.find("position"))
        place.position.emplace(point_of(*position));
    if (const auto turn = view.find("turn"))
        place.turn.emplace(turn->number());
    if (place.position || place.direction || place.turn)
        state.places[name] = place;
}

NamedState state_of(const JsonView& view)
{
    allow_only(view, {"name", "others", "lights"});
    NamedState state{.name = view.get("name").string()};
    if (!names_a_file(state.name))
        view.get("name").fail(lumel::quoted(state.name) + " is not a valid file name");
    if (const auto others = view.find("others"))
        state.light.others = factor_of(*others);
    if (const auto lights = view.find("lights"))
        for (const auto& [name, value] : lights->as_object().json().items())
            add_light_to(state.light, name, lights->get(name.c_str()));
    return state;
}

}  // namespace

void check_states(const std::vector<NamedState>& states, const std::string& path,
                  const std::function<void(const LightState&)>& check)
{
    for (const NamedState& state : states)
        try {
            check(state.light);
        } catch (const Error& error) {
            throw Error(error.kind(), path + ": state \"" + state.name + "\"", error.what());
        }
}

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
