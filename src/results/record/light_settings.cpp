#include "results/record/light_settings.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <limits>

#include <glm/trigonometric.hpp>

#include "base/core/error.h"
#include "base/core/number.h"
#include "base/json/json_file.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxDegrees = 1e6, kRightAngle = 90.0, kHalfTurn = 180.0;
constexpr double kMax = std::numeric_limits<float>::max();

std::string absolute(const std::string& path)
{
    std::error_code error;
    const fs::path result = fs::absolute(path, error);
    return error ? path : result.lexically_normal().string();
}

std::string path_in(const std::string& folder, const std::string& path)
{
    return (fs::path(folder) / path).lexically_normal().string();
}

/// The shortest number that converts back to the angle.
template <class Number>
double degrees_of(Number radians)
{
    constexpr int kMin = 6;
    for (int digits = kMin; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.*g", digits, glm::degrees(double(radians)));
        const auto degrees = number_of(text.data());
        if (degrees && Number(glm::radians(*degrees)) == radians)
            return *degrees;
    }
    return glm::degrees(double(radians));
}

Json color_of(const glm::vec3& color)
{
    return {shortest(color.r), shortest(color.g), shortest(color.b)};
}

glm::vec3 color_of(const JsonView& view)
{
    glm::vec3 color(0.0f);
    if (view.as_array().json().size() != 3)
        view.fail("must hold 3 numbers");
    view.each([&](const JsonView& channel, std::size_t c) {
        color[int(c)] = float(channel.number(0.0, kMax));
    });
    return color;
}

double radians_in(const JsonView& object, const char* name, double most)
{
    return glm::radians(object.get(name).number(-most, most));
}

Json sun_settings(const SunPosition& sun)
{
    return {{"azimuth", degrees_of(sun.azimuth)}, {"elevation", degrees_of(sun.elevation)}};
}

SunPosition sun_of(const JsonView& settings)
{
    return {radians_in(settings, "azimuth", kMaxDegrees),
            radians_in(settings, "elevation", kRightAngle)};
}

Json cie_settings(const CieSky& sky)
{
    if (sky.type == kOvercastType)
        return {{"overcast", shortest(sky.lux)}};
    Json settings = {{"cie", sky.type}, {"lux", shortest(sky.lux)}};
    if (sky.sun)
        settings["sun"] = sun_settings(*sky.sun);
    return settings;
}

CieSky cie_sky_of(const JsonView& settings)
{
    if (const auto overcast = settings.find("overcast"))
        return {.lux = float(overcast->number(0.0, kMax))};
    CieSky sky{.type = int(settings.get("cie").integer(1, kOvercastType)),
               .lux = float(settings.get("lux").number(0.0, kMax))};
    if (const auto sun = settings.find("sun"))
        sky.sun = sun_of(*sun);
    return sky;
}

void check_file(const std::string& path)
{
    std::error_code ignored;
    if (!fs::exists(path, ignored))
        throw Error(
            ErrorKind::input, path,
            "is a light of the bake, but no longer exists; restore it, or bake the scene again");
}

}  // namespace

Json light_settings(const LightOptions& options)
{
    Json settings = Json::object();
    if (!options.sky_file.empty())
        settings["sky"] = {{"file", absolute(options.sky_file)}};
    else if (options.sky_color)
        settings["sky"] = {{"radiance", color_of(*options.sky_color)}};
    else if (options.cie)
        settings["sky"] = cie_settings(*options.cie);
    if (options.sky_scale != 1.0f)
        settings["sky-scale"] = shortest(options.sky_scale);
    if (options.ground > 0.0f)
        settings["ground"] = shortest(options.ground);
    if (options.sky_rotation != 0.0)
        settings["sky-rotation"] = degrees_of(options.sky_rotation);
    if (const auto& sun = options.sun)
        settings["sun"] = sun_settings(*sun);
    if (const auto& seen = options.sun_seen)
        settings["sun"].update(
            {{"latitude", seen->latitude}, {"longitude", seen->longitude}, {"time", seen->time}});
    if (options.sun_angle)
        settings["sun-angle"] = degrees_of(*options.sun_angle);
    if (options.light_radius > 0.0f)
        settings["light-radius"] = shortest(options.light_radius);
    if (options.max_albedo != kMaxAlbedo)
        settings["max-albedo"] = shortest(options.max_albedo);
    for (const LightProfile& profile : options.profiles)
        settings["ies"].push_back({{"light", profile.light}, {"file", absolute(profile.path)}});
    return settings;
}

LightOptions light_options_of(const JsonView& settings, const std::string& folder)
{
    LightOptions options;
    if (const auto sky = settings.find("sky")) {
        if (const auto file = sky->find("file"))
            options.sky_file = path_in(folder, file->string());
        else if (sky->find("cie") || sky->find("overcast"))
            options.cie = cie_sky_of(*sky);
        else
            options.sky_color = color_of(sky->get("radiance"));
    }
    if (const auto scale = settings.find("sky-scale"))
        options.sky_scale = float(scale->number(0.0, kMax));
    if (const auto ground = settings.find("ground"))
        options.ground = float(ground->number(0.0, 1.0));
    if (settings.find("sky-rotation"))
        options.sky_rotation = radians_in(settings, "sky-rotation", kMaxDegrees);
    if (const auto sun = settings.find("sun")) {
        options.sun = sun_of(*sun);
        if (const auto time = sun->find("time"))
            options.sun_seen = {sun->get("latitude").number(-kRightAngle, kRightAngle),
                                sun->get("longitude").number(-kHalfTurn, kHalfTurn),
                                time->string()};
    }
    if (settings.find("sun-angle"))
        options.sun_angle = float(radians_in(settings, "sun-angle", kRightAngle));
    if (const auto radius = settings.find("light-radius"))
        options.light_radius = float(radius->number(0.0, kMax));
    if (const auto albedo = settings.find("max-albedo"))
        options.max_albedo = float(albedo->number(0.0, 1.0));
    settings.each("ies", [&](const JsonView& profile, std::size_t) {
        options.profiles.push_back(
            {profile.get("light").string(), path_in(folder, profile.get("file").string())});
    });
    return options;
}

void check_light_files(const LightOptions& options)
{
    if (!options.sky_file.empty())
        check_file(options.sky_file);
    for (const LightProfile& profile : options.profiles)
        check_file(profile.path);
}

}  // namespace lumel
