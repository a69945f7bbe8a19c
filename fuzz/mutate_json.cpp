#include <algorithm>
#include <string>

#include "base/json/json_view.h"
#include "mutate.h"

namespace lumel::fuzz {
namespace {

/// One in this many changes is to the text.
constexpr unsigned kOfText = 8;

std::size_t below(std::size_t count, Random& random)
{
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

void collect(Json& json, std::vector<Json*>& all)
{
    all.push_back(&json);
    for (Json& child : json)
        if (child.is_structured())
            collect(child, all);
        else
            all.push_back(&child);
}

Json some_number(const Json& old, Random& random)
{
    static const Json numbers[] = {0,        1,    -1,   2,          3,          255,
                                   65535,    -1e9, 0.5,  4294967295, 2147483648, 1e300,
                                   -1e-300,  1e38, 1e-9, 5120,       5126,       9007199254740993,
                                   1u << 24, 4,    5};
    const std::size_t choice = below(std::size(numbers) + 4, random);
    if (choice < std::size(numbers))
        return numbers[choice];
    const double value = old.is_number() ? old.get<double>() : 1.0;
    const double near[] = {value + 1.0, value - 1.0, -value, 2.0 * value};
    return near[choice - std::size(numbers)];
}

void change(Json& json, const std::vector<Json*>& all, Random& random)
{
    switch (below(6, random)) {
    case 0:
        json = Json(*all[below(all.size(), random)]);
        break;
    case 1:
        if (json.is_structured() && !json.empty()) {
            json.erase(std::next(json.begin(), std::ptrdiff_t(below(json.size(), random))));
            break;
        }
        [[fallthrough]];
    case 2:
        if (json.is_array() && !json.empty()) {
            json.push_back(Json(json[below(json.size(), random)]));
            break;
        }
        [[fallthrough]];
    case 3:
        if (json.is_string()) {
            std::string text = json.get<std::string>();
            std::vector<std::uint8_t> bytes(text.begin(), text.end());
            mutate(bytes, bytes.size() + 8);
            json = std::string(bytes.begin(), bytes.end());
            break;
        }
        [[fallthrough]];
    case 4: {
        static const Json others[] = {nullptr, true, false, "", Json::array(), Json::object()};
        if (!json.is_number() && below(2, random) == 0) {
            json = others[below(std::size(others), random)];
            break;
        }
        [[fallthrough]];
    }
    default:
        json = some_number(json, random);
    }
}

}  // namespace

void mutate_json(std::vector<std::uint8_t>& text, std::size_t room, Random& random)
{
    Json json = Json::parse(text.begin(), text.end(), nullptr, false);
    if (json.is_discarded() || below(kOfText, random) == 0) {
        mutate(text, room);
        return;
    }
    for (std::size_t changes = 1 + below(3, random); changes > 0; --changes) {
        std::vector<Json*> all;
        collect(json, all);
        change(*all[below(all.size(), random)], all, random);
    }
    const std::string changed = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (changed.size() <= room)
        text.assign(changed.begin(), changed.end());
}

}  // namespace lumel::fuzz
