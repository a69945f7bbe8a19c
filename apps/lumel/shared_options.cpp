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

Option scene_argument(std::string& scene)
{
    return {.names = "scene",
            .type = "FILE",
            .help = "A .gltf or .glb file",
            .target = &scene,
            .required = true};
}

Option result_argument(std::string& folder)
{
    return {.names = "folder",
            .type = "FOLDER",
            .help = "Where the results go",
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
        {{"--texels-per-metre", "N", "Density of the lightmap, the main control of its size",
          &atlas.texels_per_metre, "as fills the atlas", positive()},
         {"--size", "N", "Side of the square atlas in texels, instead of a density", &atlas.size,
          "as needed, from 512", whole(1, kLargestAtlas)},
         {.names = "--density",
          .type = "NAME=N",
          .help = "Texels per metre of the nodes, meshes or materials of a name, in which * and ? "
                  "stand for letters; may be repeated, the last that fits counts",
          .target =
              [&atlas](const std::string& rule) { atlas.densities.push_back(density_rule(rule)); },
          .repeatable = true},
         {"--coarse-afar", "",
          "Fewer texels for what is far from cameras and detail, as the ground around a "
          "house",
          &atlas.coarse_afar},
         {"--pages", "N",
          "Most lightmaps of that side to spread over, lightmap-0.exr and so on, where one "
          "is too small for the density, or to fill where only --size is given",
          &atlas.pages, "1", whole(1, kMaxPages)},
         {"--max-size", "N", "Largest side of the atlas; the density is lowered to fit",
          &atlas.max_size, text_of(atlas.max_size), whole(1, kLargestAtlas)},
         {"--gutter", "N", "Empty texels around each chart", &atlas.gutter, text_of(atlas.gutter),
          whole(0, kLargestGutter)}});
}

void add_sides_option(Command& command, AtlasOptions& atlas)
{
    command.add(kLightmapGroup,
                {choice(atlas.sides, kSides,
                        {"--sides", "",
                         "Of double-sided surfaces the lightmap shows both sides, with "
                         "texels and a face for each, where light may reach both (auto) or "
                         "always (both); or one side, chart by chart the brighter one "
                         "(brighter) or the front (front)"})});
}

void add_light_options(Command& command, LightOptions& lights)
{
    command.add(
        kLightGroup,
        {{"--sky", "FILE|R,G,B|overcast",
          "Light from all directions: an .exr or .hdr panorama in cd/m2, +x at its centre, "
          "one colour, or the CIE overcast sky, which gives an open horizontal plane "
          "10,000 lx; overcast:LUX sets another value",
          [&lights](const std::string& text) { set_sky(lights, text); }},
         {"--sky-scale", "F", "Factor for the light of the sky", &lights.sky_scale, "1",
          positive()},
         {"--sky-rotation", "DEGREES",
          "Rotate the sky and --sun about +y, counter-clockwise as seen from above",
          [&lights](double degrees) { lights.sky_rotation = glm::radians(degrees); }, "0",
          between(-kMaxDegrees, kMaxDegrees)},
         {"--sun", "POSITION",
          "Sun, with a clear sky unless there is a --sky: AZIMUTH,ELEVATION in degrees, "
          "the azimuth clockwise from north (-z), or LATITUDE,LONGITUDE,DATETIME such as "
          "47.5,19.0,2024-06-21T14:00:00+02:00",
          [&lights](const std::string& text) { set_sun(lights, text); }},
         {"--sun-angle", "DEGREES",
          "Half the angle of the sun's disc, and of directional lights without one",
          [&lights](double degrees) { lights.sun_angle = float(glm::radians(degrees)); },
          "0.2665 for --sun", between(0.0, kLargestSunAngle)},
         {"--light-radius", "METRES", "Radius of point and spot lights without one",
          &lights.light_radius, "0", positive()},
         {.names = "--ies",
          .type = "LIGHT=FILE",
          .help = "IES photometric file for the point or spot lights of this name; a * stands for "
                  "any letters, as in 'lamp*=lamp.ies'; may be repeated",
          .target = [&lights](const std::string& text) { add_profile(lights, text); },
          .repeatable = true}});
}

void add_json_flag(Command& command, bool& json)
{
    command.add(kProgramGroup,
                {{"--json", "", "Print one JSON document on stdout, and nothing else", &json}});
}

void add_talk_options(Command& command, Talk& talk)
{
    command.add(kProgramGroup,
                {{"-q,--quiet", "", "Print only warnings and errors", &talk.quiet},
                 {.names = "--verbose",
                  .help = "Print stages, sizes, memory and device times on stderr as they become "
                          "known",
                  .target = &talk.verbose,
                  .excludes = "--quiet"}});
    add_json_flag(command, talk.json);
    command.add(kProgramGroup,
                {{"--no-progress", "",
                  "Show no progress line; there is one only where stderr is a terminal",
                  [&talk] { talk.progress = false; }}});
}

void add_stop_options(Command& command, SolverOptions& solver)
{
    command.add(kStopGroup,
                {{"--shots", "N", "Stop after this many shooters; of links: rays of each lumel",
                  &solver.max_shots, "", whole(1, kMaxShots)},
                 {"--time", "SECONDS",
                  "Stop solving when this time has passed since the start of the command; the "
                  "results are then written",
                  &solver.max_seconds, "", positive()},
                 {.names = "--error",
                  .type = "PERCENT",
                  .help = "Stop at this estimated error of the whole map",
                  .default_value =
                      text_of(100.0 * solver.target_error) + ", or none with --shots or --time",
                  .target = [&solver](double percent) { solver.target_error = percent / 100.0; },
                  .check = positive()},
                 {"--dark-error", "PERCENT",
                  "Stop at this estimated error of the lumels below a third of the mean, as a part "
                  "of their own light (only links)",
                  [&solver](double percent) { solver.target_dark_error = percent / 100.0; }, "none",
                  positive()}});
}

void drop_default_error(const Command& command, SolverOptions& solver)
{
    if (!command.given("--error") &&
        (command.given("--shots") || command.given("--time") || command.given("--dark-error")))
        solver.target_error = 0.0;
}

void add_sky_directions_option(Command& command, BakeOptions& options)
{
    command.add(
        kLightGroup,
        {{"--sky-directions", "N",
          "Directions from which the light of the sky is gathered (not by links)",
          &options.sky_directions, text_of(options.sky_directions), whole(2, kMaxDirections)}});
}

void add_keep_lights_option(Command& command, bool& keep_lights)
{
    command.add(kLightmapGroup, {{"--keep-lights", "",
                                  "Keep lamps and skies of the scene in scene.glb, though "
                                  "their light is baked",
                                  &keep_lights}});
}

void add_scene_file_options(Command& command, BakeOptions& options)
{
    command.add(kLightmapGroup,
                {choice(options.lightmap_format, kLightmapFormats,
                        {"--lightmap-format", "",
                         "Lightmap in scene.glb: half floats or shared exponents in KTX2, with an "
                         "8-bit PNG for loaders that do not read it; the PNG alone; or none",
                         "", "ktx2"}),
                 {"--baked-size", "N",
                  "Largest side of the texture of scene-baked.glb in texels: it is as dense as the "
                  "textures of the scene where that fits, and never smaller than the lightmap",
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
                        {"--only", "", "Bake only direct or only indirect light", "", "both"})});
}

void add_directional_option(Command& command, Directional& directional)
{
    command.add(kLightmapGroup,
                {choice(directional, kDirectional,
                        {"--directional", "",
                         "Also store where the light comes from, as spherical harmonics of "
                         "order 1 or 2"})});
}

void add_device_option(Command& command, std::string& device)
{
    command.add(
        kProgramGroup,
        {{"--device", "NAME", "Vulkan device: its index or a part of its name, see lumel devices",
          &device, "the best"}});
}

void add_memory_option(Command& command, std::uint64_t& bytes)
{
    const auto check = [](const std::string& text) -> std::string {
        return bytes_of(text) ? "" : fmt::format("'{}' is no size such as 512M or 2G", text);
    };
    command.add(kProgramGroup,
                {{"--max-memory", "SIZE",
                  "Memory that the host and the device may each take, such as 512M or 2G: what "
                  "needs more is refused with a --size that fits, and links stop adding rays",
                  [&bytes](const std::string& text) { bytes = *bytes_of(text); }, "what they have",
                  check}});
}

void add_dump_option(Command& command, std::string& folder)
{
    command.add(kProgramGroup,
                {{"--dump", "FOLDER",
                  "Also write intermediate images there, as EXR and PNG: what the brightest lumel "
                  "sees, the surfaces under the sky layer by layer, near-field row sums, and power",
                  &folder}});
}

void add_preview_option(Command& command, int& width)
{
    command.add(kPictureGroup, {{"--preview-width", "N", "Width of preview.png in pixels; 0: none",
                                 &width, text_of(width), whole(0, kLargestAtlas)}});
}

void add_picture_options(Command& command, int& camera, int& width)
{
    command.add(kPictureGroup,
                {{"--camera", "N", "Camera of the file by its number, from 0", &camera,
                  "the first, or one that is chosen", whole(0, kMaxCameras)},
                 {"--width", "N", "Width of the picture in pixels", &width, text_of(width),
                  whole(1, kLargestAtlas)}});
}

}  // namespace lumel
