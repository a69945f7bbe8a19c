#include "scene/sky/light_options.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include <glm/gtc/constants.hpp>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/core/number.h"
#include "base/json/json_view.h"
#include "scene/load/albedo_cap.h"
#include "scene/load/ies.h"
#include "scene/sky/clear_sky.h"
#include "scene/sky/sky_file.h"
#include "scene/values/scene_hash.h"

namespace lumel {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& what)
{
    throw Error(ErrorKind::input, option, what);
}

std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t comma = text.find(','); comma != std::string::npos;
         comma = text.find(',', begin)) {
        parts.push_back(text.substr(begin, comma - begin));
        begin = comma + 1;
    }
    parts.push_back(text.substr(begin));
    return parts;
}

/// Uniform sky. Its resolution suits methods that sample the sky by texel.
Sky even_sky(const glm::vec3& radiance)
{
    Sky sky{.width = 64, .height = 32};
    sky.radiance.assign(std::size_t(sky.width) * std::size_t(sky.height), radiance);
    return sky;
}

constexpr std::string_view kOvercast = "overcast", kCie = "cie:";  ///< arguments of --sky
constexpr double kMaxAzimuth = 360.0;                              ///< [degrees], either way round
/// Maximum illuminance of a sky [lx]: an open plane under uniform kMaxLuminance.
constexpr double kMaxLux = glm::pi<double>() * double(kMaxLuminance);

/// Illuminance in a text [lx]; nullopt if it is none.
std::optional<float> lux_of(std::string_view text)
{
    const auto lux = number_of(text);
    if (!lux || !(*lux > 0.0) || *lux > kMaxLux || !(float(*lux) > 0.0f))
        return std::nullopt;
    return float(*lux);
}

/// Parses "overcast" or "overcast:LUX".
CieSky overcast_of(const std::string& text)
{
    if (text == kOvercast)
        return {};
    const auto lux = lux_of(std::string_view(text).substr(kOvercast.size() + 1));
    if (!lux)
        refuse("--sky", quoted(text) + " is not of the form overcast:LUX, with the illuminance of "
                                       "an open horizontal plane");
    return {.lux = *lux};
}

/// Parses "AZIMUTH,ELEVATION" of a sun above the horizon.
std::optional<SunPosition> sun_of_sky(const std::string& text)
{
    const std::vector<std::string> parts = split(text);
    if (parts.size() != 2)
        return std::nullopt;
    const auto azimuth = number_of(parts[0]), elevation = number_of(parts[1]);
    if (!azimuth || !elevation)
        return std::nullopt;
    if (std::abs(*azimuth) > kMaxAzimuth || !(*elevation >= 0.0 && *elevation <= 90.0))
        return std::nullopt;
    return SunPosition{glm::radians(*azimuth), glm::radians(*elevation)};
}

/// Parses "cie:N", with ":LUX" and "@AZIMUTH,ELEVATION" behind it or not.
CieSky cie_sky_of(const std::string& text)
{
    const std::size_t at = text.find('@'), colon = text.find(':', kCie.size());
    const std::string head = text.substr(0, at);
    const auto type = number_of(std::string_view(head).substr(kCie.size(), colon - kCie.size()));
    CieSky sky;
    bool is_good = type && *type >= 1.0 && *type <= kOvercastType && *type == std::floor(*type);
    if (is_good)
        sky.type = int(*type);
    if (colon < head.size()) {
        const auto lux = lux_of(std::string_view(head).substr(colon + 1));
        sky.lux = lux.value_or(sky.lux);
        is_good = is_good && lux;
    }
    if (at != std::string::npos) {
        sky.sun = sun_of_sky(text.substr(at + 1));
        is_good = is_good && sky.sun;
    }
    if (!is_good)
        refuse("--sky", quoted(text) + " is not of the form cie:N, cie:N:LUX or "
                                       "cie:N:LUX@AZIMUTH,ELEVATION, with N from 1 to 16, the "
                                       "illuminance of an open horizontal plane, and the sun at or "
                                       "above the horizon");
    return sky;
}

/// With the place of the sun that it depends on.
CieSky placed(CieSky sky, const std::optional<SunPosition>& sun)
{
    if (!sky.sun)
        sky.sun = sun;
    const std::string name = std::string(kCie) + std::to_string(sky.type);
    if (depends_on_sun(sky.type) && !sky.sun)
        refuse("--sky", name + " is brightest about the sun: add --sun, or write " + name +
                            "@AZIMUTH,ELEVATION for the sky alone");
    if (depends_on_sun(sky.type) && sky.sun->elevation < 0.0)
        refuse("--sky", name + " needs a sun above the horizon");
    return sky;
}

void warn_of_idle(Scene& scene, const std::string& option, const std::string& reason)
{
    scene.warnings.push_back(option + " has no effect: " + reason);
}

/// True if a rotation about +y changes the sky.
bool varies_with_azimuth(const Sky& sky)
{
    for (auto row = sky.radiance.begin(); row != sky.radiance.end(); row += sky.width)
        if (std::adjacent_find(row, row + sky.width, std::not_equal_to<>()) != row + sky.width)
            return true;
    return false;
}

/// The sun after --sky-rotation; azimuths are clockwise.
SunPosition placed_sun(const LightOptions& options)
{
    SunPosition sun = *options.sun;
    sun.azimuth -= options.sky_rotation;
    return sun;
}

/// Ground below the horizon, which reflects the light of an open sky and sun diffusely.
void add_ground(Sky& sky, float albedo, const std::optional<SunPosition>& sun)
{
    glm::vec3 light(sky_irradiance(sky));
    if (sun && sun->elevation > 0.0)
        light += float(sun_illuminance(sun->elevation) * std::sin(sun->elevation));
    const std::size_t above = sky.radiance.size() / 2;
    std::fill(sky.radiance.begin() + std::ptrdiff_t(above), sky.radiance.end(),
              albedo * light / glm::pi<float>());
}

/// Sets the requested sky, if any; rotates and scales it.
void add_sky(Scene& scene, const LightOptions& options)
{
    if (!options.sky_file.empty())
        scene.sky = read_sky(options.sky_file);
    else if (options.sky_color)
        scene.sky = even_sky(*options.sky_color);
    else if (options.cie)
        scene.sky = image_of(placed(*options.cie, options.sun));
    else if (options.sun)
        scene.sky = clear_sky(*options.sun);
    if (options.sky_rotation != 0.0) {
        if (!options.sun && !varies_with_azimuth(scene.sky))
            warn_of_idle(scene, "--sky-rotation",
                         "there is no --sun, and no sky that varies with azimuth");
        scene.sky = turned(scene.sky, options.sky_rotation);
    }
    if (options.sky_scale != 1.0f && scene.sky.empty())
        warn_of_idle(scene, "--sky-scale", "there is no sky");
    for (glm::vec3& radiance : scene.sky.radiance)
        radiance *= options.sky_scale;
    if (options.ground > 0.0f) {
        const bool is_image =
            !options.sky_file.empty() || !(options.sky_color || options.cie || options.sun);
        if (is_image)
            warn_of_idle(scene, "--ground",
                         scene.sky.empty() ? "there is no sky"
                                           : "the image of the sky has its own");
        else
            add_ground(scene.sky, options.ground, options.sun);
    }
}

void add_sun(Scene& scene, const LightOptions& options)
{
    if (options.sun->elevation > 0.0) {
        scene.lights.push_back(sun_light(placed_sun(options)));
        scene.lights.back().angle = options.sun_angle.value_or(scene.lights.back().angle);
    } else {
        scene.warnings.emplace_back("the sun is below the horizon: it gives no light");
    }
}

void give_sizes(Scene& scene, const LightOptions& options)
{
    const auto is_sun = [](const PunctualLight& light) {
        return light.kind == PunctualLight::Kind::directional;
    };
    const bool sun_takes_angle = std::ranges::any_of(scene.lights, [&](const PunctualLight& light) {
        return is_sun(light) && light.angle <= 0.0f;
    });
    if (options.sun_angle && !options.sun && !sun_takes_angle)
        warn_of_idle(scene, "--sun-angle",
                     "there is no --sun, and no directional light without an "
                     "angle");
    const bool takes_radius = std::ranges::any_of(scene.lights, [&](const PunctualLight& light) {
        return !is_sun(light) && light.radius <= 0.0f;
    });
    if (options.light_radius > 0.0f && !takes_radius)
        warn_of_idle(scene, "--light-radius", "there is no point or spot light without a radius");
    for (PunctualLight& light : scene.lights) {
        if (is_sun(light))
            light.angle = light.angle > 0.0f ? light.angle : options.sun_angle.value_or(0.0f);
        else
            light.radius = light.radius > 0.0f ? light.radius : options.light_radius;
    }
}

bool can_have_profile(const PunctualLight& light)
{
    return light.kind != PunctualLight::Kind::directional;
}

/// Names of lights that can have a profile, of those that `chosen` picks, without duplicates:
/// "\"a\", \"b\"", and the number of others.
std::string names_of(const Scene& scene, bool (*chosen)(const PunctualLight& light))
{
    constexpr std::size_t kMax = 12;  // names per sentence
    std::vector<std::string> names;
    for (const PunctualLight& light : scene.lights)
        if (can_have_profile(light) && chosen(light) &&
            std::find(names.begin(), names.end(), light.name) == names.end())
            names.push_back(light.name);
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kMax); ++i)
        list += (list.empty() ? "" : ", ") + lumel::quoted(names[i]);
    if (names.size() > kMax)
        list += " and " + std::to_string(names.size() - kMax) + " more";
    return list;
}

/// True if the pattern matches the whole name; * matches any letters or none.
bool matches(std::string_view pattern, std::string_view name)
{
    const std::size_t star = pattern.find('*');
    if (star == pattern.npos)
        return pattern == name;
    if (!name.starts_with(pattern.substr(0, star)))
        return false;
    pattern.remove_prefix(star + 1);
    for (std::size_t taken = star; taken <= name.size(); ++taken)
        if (matches(pattern, name.substr(taken)))
            return true;
    return false;
}

void attach_profile(Scene& scene, const LightProfile& profile)
{
    bool found = false;
    for (PunctualLight& light : scene.lights)
        if (can_have_profile(light) &&
            (light.name == profile.light || matches(profile.light, light.name))) {
            light.profile = int(scene.profiles.size());
            light.intensity = 1.0f;  // the file's candela replace it
            found = true;
        }
    if (!found) {
        const std::string names = names_of(scene, [](const PunctualLight&) { return true; });
        refuse("--ies", "the scene has no point or spot light " + quoted(profile.light) +
                            (names.empty() ? ", nor any other" : "; it has " + names));
    }
    scene.profiles.push_back(
        read_ies(read_file(profile.path, profile.path), profile.path, profile.light));
}

/// Warns of lights without a profile, such as copies that editors number.
void warn_of_left_out(Scene& scene)
{
    const std::string names =
        names_of(scene, [](const PunctualLight& light) { return light.profile < 0; });
    if (!names.empty())
        scene.warnings.push_back("--ies leaves out " + names +
                                 ": they keep the intensity of the file; a * in the name stands "
                                 "for any letters, as in 'lamp*=FILE'");
}

/// Editors show a point light without a direction, so that nobody sees that its nadir is level.
bool shines_sideways(const PunctualLight& light)
{
    constexpr float kLevel = 0.02f;  // sine of about 1°
    return light.kind == PunctualLight::Kind::point && light.profile >= 0 &&
           std::abs(light.transform[2].y) < kLevel;
}

void warn_of_sideways(Scene& scene)
{
    if (const std::string names = names_of(scene, shines_sideways); !names.empty())
        scene.warnings.push_back("the photometric file of " + names +
                                 " shines sideways: its nadir is the light's -z, which is level; "
                                 "turn the light by -90° about x to point it down");
}

}  // namespace

void add_lights(Scene& scene, const LightOptions& options)
{
    cap_albedo(scene, options.max_albedo);
    add_sky(scene, options);
    for (const LightProfile& profile : options.profiles)
        attach_profile(scene, profile);
    if (!options.profiles.empty())
        warn_of_left_out(scene);
    warn_of_sideways(scene);
    if (options.sun)
        add_sun(scene, options);
    give_sizes(scene, options);
    scene.hash = hash_scene(scene);
}

void set_sky(LightOptions& options, const std::string& text)
{
    if (text == kOvercast || text.starts_with(std::string(kOvercast) + ":")) {
        options.cie = overcast_of(text);
        return;
    }
    if (text.starts_with(kCie)) {
        options.cie = cie_sky_of(text);
        return;
    }
    const std::vector<std::string> parts = split(text);
    std::vector<double> values;
    for (const std::string& part : parts)
        if (const auto value = number_of(part))
            values.push_back(*value);
    if (values.size() != parts.size() && is_sky_file(text)) {
        options.sky_file = text;
        return;
    }
    if (values.size() != parts.size() || values.size() != 3 ||
        *std::min_element(values.begin(), values.end()) < 0.0)
        refuse("--sky", quoted(text) + " is neither an .exr or .hdr file, nor three numbers R,G,B "
                                       "of 0 or more in cd/m2, nor overcast or cie:N");
    if (*std::max_element(values.begin(), values.end()) > double(kMaxLuminance))
        refuse("--sky", quoted(text) + " is too bright: there is no such sky");
    options.sky_color = glm::vec3(values[0], values[1], values[2]);
}

void set_sun(LightOptions& options, const std::string& text)
{
    const std::vector<std::string> parts = split(text);
    const auto first = number_of(parts[0]);
    const auto second = parts.size() > 1 ? number_of(parts[1]) : std::nullopt;
    if ((parts.size() != 2 && parts.size() != 3) || !first || !second)
        refuse("--sun", quoted(text) +
                            " is neither AZIMUTH,ELEVATION in degrees nor LATITUDE,LONGITUDE,"
                            "DATETIME such as 47.5,19.0,2024-06-21T12:00:00Z");
    if (parts.size() == 2) {
        if (std::abs(*first) > kMaxAzimuth)
            refuse("--sun", "the azimuth must lie between -360 and 360 degrees");
        if (std::abs(*second) > 90.0)
            refuse("--sun", "the elevation must lie between -90 and 90 degrees");
        options.sun = SunPosition{glm::radians(*first), glm::radians(*second)};
        options.sun_seen.reset();
        return;
    }
    if (std::abs(*first) > 90.0 || std::abs(*second) > 180.0)
        refuse("--sun", "the latitude must lie between -90 and 90 degrees, the longitude between "
                        "-180 and 180");
    options.sun =
        sun_position(glm::radians(*first), glm::radians(*second), seconds_since_2000(parts[2]));
    options.sun_seen = {*first, *second, parts[2]};
}

void add_profile(LightOptions& options, const std::string& text)
{
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
        refuse("--ies", quoted(text) + " is not of the form LIGHT=FILE");
    options.profiles.push_back({text.substr(0, sign), text.substr(sign + 1)});
}

}  // namespace lumel
