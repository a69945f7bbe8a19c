#include "shared_options.h"

#include <vector>

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
const Choices<Compression> kCompressions = {
    {"none", Compression::none}, {"meshopt", Compression::meshopt}, {"draco", Compression::draco}};
const Choices<Quality> kQualities = {{"draft", kDraft}, {"good", kGood}, {"fine", kFine}};
const Choices<ProgressStyle> kProgressStyles = {{"auto", ProgressStyle::automatic},
                                                {"json", ProgressStyle::json},
                                                {"none", ProgressStyle::none}};
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

LampGroup lamp_group(const std::string& text)
{
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals == 0 || equals + 1 == text.size())
        refuse_value(fmt::format("--group: '{}' is not of the form NAME=PATTERN", text));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace

Option scene_argument(std::string& scene)
{
    return {.names = "scene",
            .type = "FILE",
            .help = "glTF scene, a .gltf or .glb file",
            .target = &scene,
            .required = true};
}

Option result_argument(std::string& folder)
{
    return {.names = "folder",
            .type = "FOLDER",
            .help = "Output folder",
            .target = &folder,
            .required = true};
}

Option bake_argument(std::string& folder, const std::string& help)
{
    return {.names = "folder", .type = "FOLDER", .help = help, .target = &folder, .required = true};
}

void add_atlas_options(Command& command, AtlasOptions& atlas)
{
    command.add(
        kLightmapGroup,
        {{"--texels-per-metre", "N", "Texel density of the lightmap, the main control of its size",
          &atlas.texels_per_metre, "fills the lightmap", positive()},
         {"--size", "N", "Side of the square lightmap in texels, instead of a density", &atlas.size,
          "as needed, from 512; render: 128", whole(1, kLargestAtlas)},
         {.names = "--density",
          .type = "NAME=N",
          .help = "Texels per metre of the nodes, meshes or materials of this name; * and ? match "
                  "letters; repeatable, the last match wins",
          .target =
              [&atlas](const std::string& rule) { atlas.densities.push_back(density_rule(rule)); },
          .repeatable = true},
         {"--coarse-afar", "",
          "Fewer texels for surfaces far from cameras and detail, such as the ground around a "
          "house",
          &atlas.coarse_afar},
         {"--pages", "N",
          "Maximum number of lightmap pages, lightmap-0.exr and so on, used if one is too small "
          "for the density; if only --size is given, all are filled",
          &atlas.pages, "1", whole(1, kMaxPages)},
         {"--max-size", "N", "Maximum side of the lightmap; the density is lowered to fit",
          &atlas.max_size, text_of(atlas.max_size), whole(1, kLargestAtlas)},
         {"--gutter", "N", "Empty texels around each chart", &atlas.gutter, text_of(atlas.gutter),
          whole(0, kLargestGutter)}});
}

void add_sides_option(Command& command, AtlasOptions& atlas)
{
    command.add(
        kLightmapGroup,
        {choice(atlas.sides, kSides,
                {"--sides", "",
                 "Which sides of double-sided surfaces are baked, each with texels and a face of "
                 "its own: both if light may reach both (auto), always both (both), the brighter "
                 "one of each chart (brighter), or the front (front)"})});
}

void add_light_options(Command& command, LightOptions& lights)
{
    command.add(
        kLightGroup,
        {{"--sky", "FILE|R,G,B|overcast|cie:N",
          "Sky: an .exr or .hdr panorama in cd/m2 with +x at its centre, a uniform colour in "
          "cd/m2, or the CIE overcast or standard sky N, 1 to 16, with 10,000 lx on an open "
          "horizontal plane; overcast:LUX and cie:N:LUX set another value, cie:N@AZIMUTH,ELEVATION "
          "the sun that the sky depends on, which else is that of --sun",
          [&lights](const std::string& text) { set_sky(lights, text); }},
         {"--sky-scale", "F", "Scale factor for sky radiance", &lights.sky_scale, "1", positive()},
         {"--ground", "RHO",
          "Albedo of the ground below the horizon, lit by sky and --sun; not for images of skies; "
          "usually 0.2",
          &lights.ground, "none", between(0.0, 1.0)},
         {"--sky-rotation", "DEGREES",
          "Rotate the sky and --sun about +y, counter-clockwise seen from above",
          [&lights](double degrees) { lights.sky_rotation = glm::radians(degrees); }, "0",
          between(-kMaxDegrees, kMaxDegrees)},
         {"--sun", "POSITION",
          "Sun, with a clear sky unless --sky is given: AZIMUTH,ELEVATION in degrees, azimuth "
          "clockwise from north (-z), or LATITUDE,LONGITUDE,DATETIME such as "
          "47.5,19.0,2024-06-21T14:00:00+02:00",
          [&lights](const std::string& text) { set_sun(lights, text); }},
         {"--sun-angle", "DEGREES",
          "Angular radius of the sun, and of directional lights that have none",
          [&lights](double degrees) { lights.sun_angle = float(glm::radians(degrees)); },
          "0.2665 for --sun", between(0.0, kLargestSunAngle)},
         {"--light-radius", "METRES", "Radius of point and spot lights that have none",
          &lights.light_radius, "0", positive()},
         {"--max-albedo", "RHO",
          "Maximum reflectance of materials, in the brightest channel; 1: as the file says",
          &lights.max_albedo, "0.95", between(0.0, 1.0)},
         {.names = "--ies",
          .type = "LIGHT=FILE",
          .help = "IES photometric file for the point or spot lights of this name; * matches any "
                  "letters, as in 'lamp*=lamp.ies'; repeatable",
          .target = [&lights](const std::string& text) { add_profile(lights, text); },
          .repeatable = true}});
}

void add_json_flag(Command& command, bool& json)
{
    command.add(kProgramGroup,
                {{"--json", "", "Print one JSON document on stdout and nothing else", &json}});
}

void add_talk_options(Command& command, Talk& talk)
{
    command.add(
        kProgramGroup,
        {{"-q,--quiet", "", "Print only warnings and errors", &talk.quiet},
         {.names = "--verbose",
          .help = "Print stages, sizes, memory and GPU times on stderr as the work proceeds",
          .target = &talk.verbose,
          .excludes = "--quiet"}});
    add_json_flag(command, talk.json);
    command.add(kProgramGroup,
                {choice(talk.progress, kProgressStyles,
                        {"--progress",
                         "",
                         "Progress on stderr: a bar if it is a terminal (auto); lines of JSON for "
                         "other programs, at most ten a second in a stage (json); or none",
                         {},
                         "auto"})});
}

void add_stop_options(Command& command, SolverOptions& solver)
{
    command.add(
        kStopGroup,
        {{"--shots", "N", "Stop after this many shooters; with links, rays per lumel",
          &solver.max_shots, "", whole(1, kMaxShots)},
         {"--time", "SECONDS",
          "Stop solving this long after the start of the command, then write the results",
          &solver.max_seconds, "", positive()},
         choice(solver.target_quality, kQualities,
                {.names = "--quality",
                 .help = "Stop when the estimated noise that is seen on plain walls is 1 % (draft: "
                         "clouds and grain show), 0.5 % (good: clean at first sight) or 0.2 % "
                         "(fine: clean at three times the size), and errors in corners ten times "
                         "that; only links",
                 .default_value = "good, but at most " + text_of(kDefaultRays) +
                                  " rays per lumel; none with --error, --shots, --time or "
                                  "--dark-error"}),
         {"--error", "PERCENT", "Stop at this estimated relative error of the whole lightmap",
          [&solver](double percent) { solver.target_error = percent / 100.0; },
          "none; 2 with other methods than links, or none with --shots or --time", positive()},
         {"--dark-error", "PERCENT",
          "Stop when dark areas (below a third of the mean) reach this estimated relative error "
          "(only links)",
          [&solver](double percent) { solver.target_dark_error = percent / 100.0; }, "none",
          positive()}});
}

void set_default_target(const Command& command, SolverOptions& solver)
{
    if (command.given("--error"))
        return;
    const bool has_limit = command.given("--quality") || command.given("--shots") ||
                           command.given("--time") || command.given("--dark-error");
    if (has_limit)
        solver.target_error = 0.0;
    else
        set_default_limits(solver);
}

void add_sky_directions_option(Command& command, BakeOptions& options)
{
    command.add(
        kLightGroup,
        {{"--sky-directions", "N", "Number of directions that sample the sky (not by links)",
          &options.sky_directions, text_of(options.sky_directions), whole(2, kMaxDirections)}});
}

void add_keep_lights_option(Command& command, bool& keep_lights)
{
    command.add(kLightmapGroup, {{"--keep-lights", "",
                                  "Keep lamps and skies in scene.glb although their light is baked",
                                  &keep_lights}});
}

void add_scene_file_options(Command& command, BakeOptions& options)
{
    command.add(kLightmapGroup,
                {choice(options.lightmap_format, kLightmapFormats,
                        {"--lightmap-format",
                         "",
                         "Lightmap in scene.glb: KTX2 with half floats (ktx2) or shared exponents "
                         "(rgb9e5), both with an 8-bit PNG for loaders that do not read KTX2; only "
                         "the PNG (png); or none",
                         {},
                         "ktx2"}),
                 choice(options.compression, kCompressions,
                        {"--compress",
                         "",
                         "Compression of vertices and indices in scene.glb, which the viewer must "
                         "read: EXT_meshopt_compression, without loss (meshopt), "
                         "KHR_draco_mesh_compression, rounded (draco); or none",
                         {},
                         "none"}),
                 {"--baked-size", "N",
                  "Maximum side of the texture of scene-baked.glb in texels; it is as dense as the "
                  "scene's textures if that fits, and never smaller than the lightmap",
                  &options.baked_size, text_of(options.baked_size), whole(1, kLargestAtlas)}});
}

void add_half_option(Command& command, bool& half)
{
    command.add(kLightmapGroup, {{"--half", "", "Write lightmap.exr in half precision", &half}});
}

void add_only_option(Command& command, Parts& parts)
{
    command.add(kLightmapGroup,
                {choice(parts, kParts,
                        {"--only", "", "Bake only direct or only indirect light", {}, "both"})});
}

void add_directional_option(Command& command, Directional& directional)
{
    command.add(kLightmapGroup, {choice(directional, kDirectional,
                                        {"--directional", "",
                                         "Also store the direction of incident light, as spherical "
                                         "harmonics of order 1 or 2"})});
}

void add_group_option(Command& command, const char* title, const std::string& implied,
                      std::vector<LampGroup>& groups)
{
    command.add(
        title,
        {{.names = "--group",
          .type = "NAME=PATTERN",
          .help = "Keep all lamps whose names fit the pattern as one, such as "
                  "kitchen='lamp_k*'; turns " +
                  implied + " on",
          .target = [&groups](const std::string& text) { groups.push_back(lamp_group(text)); },
          .repeatable = true}});
}

void add_device_option(Command& command, std::string& device)
{
    command.add(kProgramGroup, {{"--device", "NAME",
                                 "Vulkan device, by index or part of its name; see lumel devices",
                                 &device, "the best"}});
}

void add_memory_option(Command& command, std::uint64_t& bytes)
{
    const auto check = [](const std::string& text) -> std::string {
        return bytes_of(text) ? "" : fmt::format("'{}' is no size such as 512M or 2G", text);
    };
    command.add(
        kProgramGroup,
        {{"--max-memory", "SIZE",
          "CPU and GPU memory limit (each), such as 512M or 2G: a bake that needs more is refused, "
          "with a --size that fits; links stop adding rays",
          [&bytes](const std::string& text) { bytes = *bytes_of(text); }, "all available", check}});
}

void add_dump_option(Command& command, std::string& folder)
{
    command.add(
        kProgramGroup,
        {{"--dump", "FOLDER",
          "Also write intermediate images to this folder, as EXR and PNG: the view from the "
          "brightest lumel, the layers of surfaces under the sky, near-field row sums, and power",
          &folder}});
}

void add_preview_option(Command& command, int& width)
{
    command.add(kPictureGroup,
                {{"--preview-width", "N", "Width of preview.png in pixels; 0: no preview", &width,
                  text_of(width), whole(0, kLargestAtlas)}});
}

void add_picture_options(Command& command, int& camera, int& width)
{
    command.add(kPictureGroup, {{"--camera", "N", "Camera of the file, by number from 0", &camera,
                                 "the first, else chosen automatically", whole(0, kMaxCameras)},
                                {"--width", "N", "Width of the image in pixels", &width,
                                 text_of(width), whole(1, kLargestAtlas)}});
}

}  // namespace lumel
