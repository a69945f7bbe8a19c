#include "api/fields.h"

#include <algorithm>
#include <map>
#include <regex>
#include <string_view>

#include "methods/methods.h"

namespace lumel::v0 {
namespace {

/// By names of options, without dashes.
const std::map<std::string, std::string, std::less<>> kFields = {
    {"coarse-afar", "AtlasSettings::coarse_afar"},
    {"dark-error", "BakeSettings::dark_error"},
    {"daylight", "BakeSettings::weather_file"},
    {"density", "AtlasSettings::densities"},
    {"device", "Device::Device"},
    {"directional", "BakeSettings::directional"},
    {"error", "BakeSettings::error"},
    {"ground", "Daylight::ground"},
    {"group", "BakeSettings::groups"},
    {"gutter", "AtlasSettings::gutter"},
    {"max-memory", "BakeSettings::max_memory"},
    {"max-size", "AtlasSettings::max_size"},
    {"only", "BakeSettings::parts"},
    {"pages", "AtlasSettings::pages"},
    {"per-lamp", "BakeSettings::per_lamp"},
    {"quality", "BakeSettings::visible_noise or eye_error"},
    {"shots", "BakeSettings::shots"},
    {"sides", "AtlasSettings::sides"},
    {"size", "AtlasSettings::size"},
    {"sky", "Scene::add_daylight"},
    {"sky-rotation", "Daylight::rotation"},
    {"sky-scale", "Daylight::sky_scale"},
    {"solver", "BakeSettings::method"},
    {"sun", "Daylight::sun"},
    {"texels-per-metre", "AtlasSettings::texels_per_metre"},
    {"time", "BakeSettings::seconds"},
};

/// Of an option that the library does not have.
constexpr std::string_view kNotHere = " (--max-albedo)";

/// Unchanged if there is no such field.
std::string field_of(const std::string& option)
{
    if (const auto field = kFields.find(option); field != kFields.end())
        return field->second;
    const auto is_it = [&](const SharedOption& one) { return option == one.info->name; };
    if (std::ranges::any_of(options_of_methods(), is_it))
        return "BakeSettings::options[\"" + option + "\"]";
    return "--" + option;
}

}  // namespace

std::string in_fields(const std::string& given)
{
    std::string message = given;
    if (const std::size_t at = message.find(kNotHere); at != message.npos)
        message.erase(at, kNotHere.size());
    // At the beginning of a word: not in the name of a file.
    static const std::regex option("(^|[ (\"])--([a-z]+(-[a-z]+)*)");
    std::string result;
    auto from = message.cbegin();
    for (std::sregex_iterator at(message.begin(), message.end(), option), end; at != end; ++at) {
        result.append(from, (*at)[1].second);
        result += field_of((*at)[2]);
        from = (*at)[0].second;
    }
    return result.append(from, message.cend());
}

std::vector<std::string> in_fields(const std::vector<std::string>& messages)
{
    std::vector<std::string> result;
    for (const std::string& message : messages)
        result.push_back(in_fields(message));
    return result;
}

}  // namespace lumel::v0
