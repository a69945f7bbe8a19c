#include "shared_options.h"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <glm/trigonometric.hpp>

#include "base/core/error.h"
#include "base/core/number.h"
#include "option_values.h"

namespace lumel {
namespace {

constexpr int kLargestGutter = 64;
constexpr double kMaxTexelsPerMetre = 1e6;
constexpr int kMaxCameras = 1'000'000;
constexpr int kMaxDirections = 1'000'000;
constexpr double kMaxDegrees = 36000.0;    // a turn that still has decimals as float
constexpr double kLargestSunAngle = 45.0;  // half a disc [degrees]

const Choices<Directional> kDirectional = {{"sh1", Directional::sh1}, {"sh2", Directional::sh2}};
const Choices<LightmapFormat> kLightmapFormats = {{"ktx2", LightmapFormat::ktx2},
                                                  {"rgb9e5", LightmapFormat::rgb9e5},
                                                  {"png", LightmapFormat::png},
                                                  {"none", LightmapFormat::none}};
const Choices<Sides> kSides = {{"auto", Sides::automatic},
                               {"both", Sides::both},
                               {"brighter", Sides::brighter},
                               {"front", Sides::front}};
const Choices<Parts> kParts = {{"direct", Parts::direct}, {"indirect", Parts::indirect}};

/// "wall*=40"
DensityRule density_rule(const std::string& text)
{
    const std::size_t equals = text.rfind('=');
    const auto density = number_of(equals == text.npos ? std::string() : text.substr(equals + 1));
    if (equals == 0 || !density || !(*density > 0.0) || *density > kMaxTexelsPerMetre)
        throw Error(
            ErrorKind::input, "",
            fmt::format("--density: '{}' is not of the form NAME=N with a positive number", text));
    return {text.substr(0, equals), float(*density)};
}

}  // namespace

void add_atlas_options(CLI::App& app, AtlasOptions& atlas)
{
    app.option_defaults()->group(kLightmapGroup);
    app.add_option("--texels-per-metre", atlas.texels_per_metre,
                   "Density of the lightmap, the main control of its size")
        ->type_name("N")
        ->default_str("as fills the atlas")
        ->check(positive());
    app.add_option("--size", atlas.size, "Side of the square atlas in texels, instead of a density")
        ->type_name("N")
        ->default_str("as needed, from 512")
        ->check(whole(1, kLargestAtlas));
    app.add_option_function<std::vector<std::string>>(
           "--density",
           [&atlas](const std::vector<std::string>& rules) {
               for (const std::string& rule : rules)
                   atlas.densities.push_back(density_rule(rule));
           },
           "Texels per metre of the nodes, meshes or materials of a name, in which * and ? stand "
           "for letters; may be repeated, the last that fits counts")
        ->type_name("NAME=N")
        ->allow_extra_args(false);  // one at a time, so that a file may follow
    app.add_flag(
        "--coarse-afar", atlas.coarse_afar,
        "Fewer texels for what is far from cameras and detail, as the ground around a house");
    app.add_option(
           "--pages", atlas.pages,
           "Most lightmaps of that side to spread over, lightmap-0.exr and so on, where one "
           "is too small for the density, or to fill where only --size is given")
        ->type_name("N")
        ->default_str("1")
        ->check(whole(1, kMaxPages));
    app.add_option("--max-size", atlas.max_size,
                   "Largest side of the atlas; the density is lowered to fit")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kLargestAtlas));
    app.add_option("--gutter", atlas.gutter, "Empty texels around each chart")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kLargestGutter));
}

void add_sides_option(CLI::App& app, AtlasOptions& atlas)
{
    add_choice(app, "--sides", atlas.sides, kSides,
               "Of double-sided surfaces the lightmap shows both sides, with texels and a face for "
               "each, where light may reach both (auto) or always (both); or one side, chart by "
               "chart the brighter one (brighter) or the front (front)");
}

void add_light_options(CLI::App& app, LightOptions& lights)
{
    app.option_defaults()->group(kLightGroup);
    app.add_option_function<std::string>(
           "--sky", [&lights](const std::string& text) { set_sky(lights, text); },
           "Light from all directions: an .exr or .hdr panorama in cd/m2, +x at its centre, one "
           "colour, or the CIE overcast sky, which gives an open horizontal plane 10,000 lx; "
           "overcast:LUX sets another value")
        ->type_name("FILE|R,G,B|overcast");
    app.add_option("--sky-scale", lights.sky_scale, "Factor for the light of the sky")
        ->type_name("F")
        ->default_str("1")
        ->check(positive());
    app.add_option_function<double>(
           "--sky-rotation",
           [&lights](double degrees) { lights.sky_rotation = glm::radians(degrees); },
           "Rotate the sky and --sun about +y, counter-clockwise as seen from above")
        ->type_name("DEGREES")
        ->default_str("0")
        ->check(between(-kMaxDegrees, kMaxDegrees));
    app.add_option_function<std::string>(
           "--sun", [&lights](const std::string& text) { set_sun(lights, text); },
           "Sun, with a clear sky unless there is a --sky: AZIMUTH,ELEVATION in degrees, the "
           "azimuth clockwise from north (-z), or LATITUDE,LONGITUDE,DATETIME such as "
           "47.5,19.0,2024-06-21T14:00:00+02:00")
        ->type_name("POSITION");
    app.add_option_function<double>(
           "--sun-angle",
           [&lights](double degrees) { lights.sun_angle = float(glm::radians(degrees)); },
           "Half the angle of the sun's disc, and of directional lights without one")
        ->type_name("DEGREES")
        ->default_str("0.2665 for --sun")
        ->check(between(0.0, kLargestSunAngle));
    app.add_option("--light-radius", lights.light_radius,
                   "Radius of point and spot lights without one")
        ->type_name("METRES")
        ->default_str("0")
        ->check(positive());
    app.add_option_function<std::vector<std::string>>(
           "--ies",
           [&lights](const std::vector<std::string>& texts) {
               for (const std::string& text : texts)
                   add_profile(lights, text);
           },
           "IES photometric file for the point or spot lights of this name; a * stands for any "
           "letters, as in 'lamp*=lamp.ies'; may be repeated")
        ->type_name("LIGHT=FILE")
        ->allow_extra_args(false);  // one at a time, so that a scene may follow
}

void add_json_flag(CLI::App& app, bool& json)
{
    app.option_defaults()->group(kProgramGroup);
    app.add_flag("--json", json, "Print one JSON document on stdout, and nothing else");
}

void add_talk_options(CLI::App& app, Talk& talk)
{
    app.option_defaults()->group(kProgramGroup);
    auto* quiet = app.add_flag("-q,--quiet", talk.quiet, "Print only warnings and errors");
    app.add_flag("--verbose", talk.verbose,
                 "Print stages, sizes, memory and device times on stderr as they become known")
        ->excludes(quiet);
    add_json_flag(app, talk.json);
    app.add_flag_callback(
        "--no-progress", [&talk] { talk.progress = false; },
        "Show no progress line; there is one only where stderr is a terminal");
}

void add_stop_options(CLI::App& app, SolverOptions& solver)
{
    app.option_defaults()->group(kStopGroup);
    auto* shots = app.add_option("--shots", solver.max_shots,
                                 "Stop after this many shooters; of links: rays of each lumel")
                      ->type_name("N")
                      ->check(whole(1, kMaxShots));
    auto* time = app.add_option("--time", solver.max_seconds,
                                "Stop solving when this time has passed since the start of the "
                                "command; the results are then "
                                "written")
                     ->type_name("SECONDS")
                     ->check(positive());
    auto* error = app.add_option_function<double>(
        "--error", [&solver](double percent) { solver.target_error = percent / 100.0; },
        "Stop at this estimated error of the whole map");
    error->type_name("PERCENT")
        ->default_str(
            fmt::format("{:g}, or none with --shots or --time", 100.0 * solver.target_error))
        ->check(positive());
    auto* dark = app.add_option_function<double>(
        "--dark-error", [&solver](double percent) { solver.target_dark_error = percent / 100.0; },
        "Stop at this estimated error of the lumels below a third of the mean, as a part of their "
        "own light (only links)");
    dark->type_name("PERCENT")->default_str("none")->check(positive());
    app.callback([&solver, shots, time, error, dark] {
        if (error->empty() && !(shots->empty() && time->empty() && dark->empty()))
            solver.target_error = 0.0;
    });
}

void add_sky_directions_option(CLI::App& app, BakeOptions& options)
{
    app.option_defaults()->group(kLightGroup);
    app.add_option("--sky-directions", options.sky_directions,
                   "Directions from which the light of the sky is gathered (not by links)")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(2, kMaxDirections));
}

void add_keep_lights_option(CLI::App& app, bool& keep_lights)
{
    app.option_defaults()->group(kLightmapGroup);
    app.add_flag("--keep-lights", keep_lights,
                 "Keep lamps and skies of the scene in scene.glb, though their light is baked");
}

void add_scene_file_options(CLI::App& app, BakeOptions& options)
{
    app.option_defaults()->group(kLightmapGroup);
    add_choice(app, "--lightmap-format", options.lightmap_format, kLightmapFormats,
               "Lightmap in scene.glb: half floats or shared exponents in KTX2, with an 8-bit PNG "
               "for loaders that do not read it; the PNG alone; or none")
        ->default_str("ktx2");
    app.add_option("--baked-size", options.baked_size,
                   "Largest side of the texture of scene-baked.glb in texels: it is as dense as "
                   "the textures of the scene where that fits, and never smaller than the lightmap")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kLargestAtlas));
}

void add_half_option(CLI::App& app, bool& half)
{
    app.option_defaults()->group(kLightmapGroup);
    app.add_flag("--half", half, "Write lightmap.exr in half precision");
}

void add_only_option(CLI::App& app, Parts& parts)
{
    app.option_defaults()->group(kLightmapGroup);
    add_choice(app, "--only", parts, kParts, "Bake only direct or only indirect light")
        ->default_str("both");
}

void add_directional_option(CLI::App& app, Directional& directional)
{
    app.option_defaults()->group(kLightmapGroup);
    add_choice(app, "--directional", directional, kDirectional,
               "Also store where the light comes from, as spherical harmonics of order 1 or 2");
}

void add_device_option(CLI::App& app, std::string& device)
{
    app.option_defaults()->group(kProgramGroup);
    app.add_option("--device", device,
                   "Vulkan device: its index or a part of its name, see lumel devices")
        ->type_name("NAME")
        ->default_str("the best");
}

void add_memory_option(CLI::App& app, std::uint64_t& bytes)
{
    app.option_defaults()->group(kProgramGroup);
    app.add_option_function<std::string>(
           "--max-memory", [&bytes](const std::string& text) { bytes = *bytes_of(text); },
           "Memory that the host and the device may each take, such as 512M or 2G: what needs more "
           "is refused with a --size that fits, and links stop adding rays")
        ->type_name("SIZE")
        ->default_str("what they have")
        ->check([](const std::string& text) -> std::string {
            return bytes_of(text) ? "" : fmt::format("'{}' is no size such as 512M or 2G", text);
        });
}

void add_dump_option(CLI::App& app, std::string& folder)
{
    app.option_defaults()->group(kProgramGroup);
    app.add_option(
           "--dump", folder,
           "Also write intermediate images there, as EXR and PNG: what the brightest lumel "
           "sees, the surfaces under the sky layer by layer, near-field row sums, and power")
        ->type_name("FOLDER");
}

void add_preview_option(CLI::App& app, int& width)
{
    app.option_defaults()->group(kPictureGroup);
    app.add_option("--preview-width", width, "Width of preview.png in pixels; 0: none")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kLargestAtlas));
}

void add_picture_options(CLI::App& app, int& camera, int& width)
{
    app.option_defaults()->group(kPictureGroup);
    app.add_option("--camera", camera, "Camera of the file by its number, from 0")
        ->type_name("N")
        ->default_str("the first, or one that is chosen")
        ->check(whole(0, kMaxCameras));
    app.add_option("--width", width, "Width of the picture in pixels")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kLargestAtlas));
}

}  // namespace lumel
