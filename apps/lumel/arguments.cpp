// The command line as CLI11 reads it. Every option that a user sees is declared here.

#include "arguments.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <glm/trigonometric.hpp>

#include "core/error.h"
#include "core/number.h"
#include "manual.h"
#include "method_options.h"

namespace lumel {
namespace {

constexpr int kLargestAtlas = 16384;  // the largest image side that common devices offer [texels]
constexpr int kLargestGutter = 64;
constexpr int kMostShots = 2'000'000'000;
/// A day.
constexpr double kMostCheckpointSeconds = 86'400.0;
constexpr int kMostPaths = 100'000'000;
constexpr int kMostFrames = 100'000;
constexpr int kMostAnimations = 1'000'000;
constexpr double kMostFps = 1000.0;  // pictures a second
constexpr int kMostCameras = 1'000'000;
constexpr int kMostPlaces = 256;
constexpr int kMostRays = 4096;
constexpr int kMostDirections = 1'000'000;
constexpr double kMostDegrees = 36000.0;   // a turn that still has decimals as float
constexpr double kLargestSunAngle = 45.0;  // half a disc [degrees]

// Titles that --help and docs/options.md put above options.
constexpr const char* kLightGroup = "Light";
constexpr const char* kLightmapGroup = "Lightmap";
constexpr const char* kStopGroup = "When to stop";
constexpr const char* kPictureGroup = "Pictures";
constexpr const char* kAnimationGroup = "Animation";
constexpr const char* kProgramGroup = "Device and messages";

/// Accepts whole numbers from `low` to `high`.
CLI::Validator whole(std::int64_t low, std::int64_t high)
{
    const auto check = [low, high](const std::string& text) -> std::string {
        std::int64_t value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high)
            return {};
        return fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
    };
    return CLI::Validator(check, "");
}

/// Accepts positive finite numbers.
CLI::Validator positive()
{
    const auto check = [](const std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value))
            return {};
        return fmt::format("'{}' is not a number above 0", text);
    };
    return CLI::Validator(check, "");
}

/// Accepts finite numbers from `low` to `high`.
CLI::Validator between(double low, double high)
{
    const auto check = [low, high](const std::string& text) -> std::string {
        const auto value = number_of(text);
        if (value && *value >= low && *value <= high)
            return {};
        return fmt::format("'{}' is not a number from {:g} to {:g}", text, low, high);
    };
    return CLI::Validator(check, "");
}

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

const Choices<SampleRule> kSampleRules = {{"area", SampleRule::area},
                                          {"centre", SampleRule::centre}};
const Choices<Directional> kDirectional = {{"sh1", Directional::sh1}, {"sh2", Directional::sh2}};
const Choices<LightmapFormat> kLightmapFormats = {{"ktx2", LightmapFormat::ktx2},
                                                  {"rgb9e5", LightmapFormat::rgb9e5},
                                                  {"png", LightmapFormat::png},
                                                  {"none", LightmapFormat::none}};
const Choices<Parts> kParts = {{"direct", Parts::direct}, {"indirect", Parts::indirect}};
const Choices<Sides> kSides = {{"auto", Sides::automatic},
                               {"both", Sides::both},
                               {"brighter", Sides::brighter},
                               {"front", Sides::front}};
const Choices<Redistribution> kRedistributions = {{"incremental", Redistribution::incremental},
                                                  {"cross", Redistribution::cross}};

/// An option that takes one of a few words.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const Choices<Value>& choices, const std::string& help)
{
    const auto assign = [&value, &choices](const std::string& word) {
        for (const auto& [choice, meaning] : choices)
            if (choice == word)
                value = meaning;
    };
    std::vector<std::string> words;
    std::string standard;
    for (const auto& [choice, meaning] : choices) {
        words.push_back(choice);
        if (meaning == value)
            standard = choice;
    }
    return app.add_option_function<std::string>(name, assign, help)
        ->type_name(CLI::detail::join(words, "|"))
        ->default_str(standard)
        ->check([words](const std::string& word) -> std::string {
            if (std::find(words.begin(), words.end(), word) != words.end())
                return {};
            return fmt::format("'{}' is none of {}", word, CLI::detail::join(words, ", "));
        });
}

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

/// Of what writes or measures lightmaps.
void add_sides_option(CLI::App& app, AtlasOptions& atlas)
{
    add_choice(app, "--sides", atlas.sides, kSides,
               "Of double-sided surfaces the lightmap shows both sides, with texels and a face for "
               "each, where light may reach both (auto) or always (both); or one side, chart by "
               "chart the brighter one (brighter) or the front (front)");
}

/// Light from outside, and what lamps are like.
void add_light_options(CLI::App& app, LightOptions& lights)
{
    app.option_defaults()->group(kLightGroup);
    app.add_option_function<std::string>(
           "--sky", [&lights](const std::string& text) { set_sky(lights, text); },
           "Light from all directions: an .exr or .hdr panorama in cd/m2, +x at its centre, or one "
           "colour")
        ->type_name("FILE|R,G,B");
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
        ->check(between(-kMostDegrees, kMostDegrees));
    app.add_option_function<std::string>(
           "--sun", [&lights](const std::string& text) { set_sun(lights, text); },
           "Sun, with a clear sky unless there is a --sky: AZIMUTH,ELEVATION in degrees, the "
           "azimuth clockwise from north (-z), or LATITUDE,LONGITUDE,DATETIME such as "
           "47.5,19.0,2024-06-21T12:00:00Z")
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
           "IES photometric file for the point or spot lights of this name; may be repeated")
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

/// When to stop. Without any of the three the bake ends at the default error.
void add_stop_options(CLI::App& app, SolverOptions& solver)
{
    app.option_defaults()->group(kStopGroup);
    auto* shots = app.add_option("--shots", solver.max_shots,
                                 "Stop after this many shooters; of links: rays of each lumel")
                      ->type_name("N")
                      ->check(whole(1, kMostShots));
    auto* time = app.add_option("--time", solver.max_seconds, "Stop after solving for this time")
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
        ->check(whole(2, kMostDirections));
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

void add_resume_options(CLI::App& app, BakeOptions& options)
{
    app.option_defaults()->group(kStopGroup);
    app.add_flag("--resume", options.resume,
                 "Go on with a bake that was killed or failed, from its checkpoint in the folder; "
                 "begin anew if there is none (only links)");
    app.add_option("--checkpoint", options.checkpoint_seconds,
                   "Time between two checkpoints that --resume goes on from; 0: none (only links)")
        ->type_name("SECONDS")
        ->capture_default_str()
        ->check(between(0.0, kMostCheckpointSeconds));
}

CLI::App& add_bake(CLI::App& app, BakeArguments& bake, GivenMethod& method)
{
    CLI::App& command = *app.add_subcommand("bake", "Solve the light of a scene into lightmaps");
    command.add_option("scene", bake.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    command.add_option("folder", bake.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    add_light_options(command, bake.options.lights);
    add_sky_directions_option(command, bake.options);
    add_atlas_options(command, bake.options.atlas);
    add_sides_option(command, bake.options.atlas);
    command.option_defaults()->group(kMethodGroup);
    add_methods(command, method);
    add_stop_options(command, bake.options.solver);
    add_resume_options(command, bake.options);
    add_device_option(command, bake.options.device);
    add_half_option(command, bake.options.half);
    add_keep_lights_option(command, bake.options.keep_lights);
    add_scene_file_options(command, bake.options);
    add_only_option(command, bake.options.parts);
    add_directional_option(command, bake.options.directional);
    add_preview_option(command, bake.options.preview_width);
    add_dump_option(command, bake.options.dump);
    add_talk_options(command, bake.talk);
    return command;
}

CLI::App& add_update(CLI::App& app, UpdateArguments& update)
{
    CLI::App& command =
        *app.add_subcommand("update", "Correct the lightmaps of a bake where its scene was edited");
    UpdateOptions& options = update.options;
    command.add_option("folder", update.folder, "What lumel bake wrote, corrected in place")
        ->required()
        ->type_name("FOLDER");
    command.add_option("scene", update.scene, "The edited scene, a .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    command
        .add_option_function<double>(
            "--residual", [&options](double percent) { options.residual = percent / 100.0; },
            "Stop at this error of the correction, as a part of all light")
        ->type_name("PERCENT")
        ->group(kStopGroup)
        ->default_str(fmt::format("{:g}", 100.0 * options.residual))
        ->check(positive());
    add_light_options(command, options.lights);
    add_device_option(command, options.device);
    add_preview_option(command, options.preview_width);
    add_talk_options(command, update.talk);
    return command;
}

CLI::App& add_relight(CLI::App& app, RelightArguments& relight)
{
    CLI::App& command = *app.add_subcommand(
        "relight",
        "Light a bake of --solver matrix anew, with its lights dimmed, coloured or switched off");
    command.add_option("folder", relight.folder, "What lumel bake --solver matrix wrote")
        ->required()
        ->type_name("FOLDER");
    command
        .add_option("states", relight.states,
                    "JSON: {\"states\": [{\"name\": \"evening\", \"others\": 0, \"lights\": "
                    "{\"lamp\": 0.5, \"sky\": [0.2, 0.3, 0.6]}}]}")
        ->required()
        ->type_name("FILE");
    add_device_option(command, relight.options.device);
    add_talk_options(command, relight.talk);
    return command;
}

/// A place in a lightmap, as two numbers with a comma.
void add_place_options(CLI::App& app, WhyOptions& options)
{
    app.option_defaults()->group("Point of the lightmap");
    auto* lumel = app.add_option_function<std::vector<double>>(
                         "--lumel",
                         [&options](const std::vector<double>& uv) {
                             options.place = {uv[0], uv[1]};
                         },
                         "Point of the lightmap in TEXCOORD_1: 0,0 is its top left corner, 1,1 "
                         "the bottom right one")
                      ->type_name("U,V")
                      ->delimiter(',')
                      ->expected(2)
                      ->check(between(0.0, 1.0));
    auto* texel =
        app.add_option_function<std::vector<int>>(
               "--texel",
               [&options](const std::vector<int>& at) { options.texel = glm::ivec2(at[0], at[1]); },
               "The same as column and row of a texel, from 0,0")
            ->type_name("X,Y")
            ->delimiter(',')
            ->expected(2)
            ->check(whole(0, kLargestAtlas - 1));
    texel->excludes(lumel);
    app.callback([&app] {
        if (app.count("--lumel") + app.count("--texel") == 0)
            throw Error(ErrorKind::input, "", "lumel why needs --lumel U,V or --texel X,Y");
    });
}

CLI::App& add_why(CLI::App& app, WhyArguments& why)
{
    CLI::App& command = *app.add_subcommand(
        "why", "List what sends light to a point of a baked lightmap, and show it in why.png");
    command.add_option("folder", why.folder, "What lumel bake wrote")
        ->required()
        ->type_name("FOLDER");
    add_place_options(command, why.options);
    command.add_option("--width", why.options.width, "Width of why.png in pixels; 0: none")
        ->group(kPictureGroup)
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kLargestAtlas));
    add_device_option(command, why.options.device);
    add_talk_options(command, why.talk);
    return command;
}

/// Who looks, and how finely.
void add_picture_options(CLI::App& app, int& camera, int& width)
{
    app.option_defaults()->group(kPictureGroup);
    app.add_option("--camera", camera, "Camera of the file by its number, from 0")
        ->type_name("N")
        ->default_str("the first, or one that is chosen")
        ->check(whole(0, kMostCameras));
    app.add_option("--width", width, "Width of the picture in pixels")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kLargestAtlas));
}

CLI::App& add_render(CLI::App& app, RenderArguments& render, GivenMethod& method)
{
    CLI::App& command = *app.add_subcommand(
        "render", "Make a picture of a scene from one of its cameras, glossy reflections included");
    RenderOptions& options = render.options;
    command.add_option("scene", render.scene, "A .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    command.add_option("picture", render.picture, "PNG, or EXR of radiance in cd/m2")
        ->required()
        ->type_name("FILE");
    add_picture_options(command, options.camera, options.width);
    command.add_option("--height", options.height, "Height of the picture in pixels")
        ->type_name("N")
        ->default_str("from the camera")
        ->check(whole(1, kLargestAtlas));
    command.add_option("--places", options.sets, "Sample points in each pixel")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kMostPlaces));
    command
        .add_option("--eye-shots", options.shots,
                    "Shooters for glossy reflections in view, after those of the solution")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMostShots));
    command.add_option("--lobe-rays", options.rays, "Rays along the lobe at each sample point")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMostRays));
    command
        .add_option("--paths", options.paths,
                    "Trace this many paths per pixel on the processor instead, to compare with")
        ->type_name("N")
        ->check(whole(1, kMostPaths));
    add_light_options(command, options.bake.lights);
    add_sky_directions_option(command, options.bake);
    add_atlas_options(command, options.bake.atlas);
    command.option_defaults()->group(kMethodGroup);
    add_one_method(command, method);
    add_stop_options(command, options.bake.solver);
    add_device_option(command, options.bake.device);
    add_dump_option(command, options.bake.dump);
    add_talk_options(command, render.talk);
    return command;
}

/// What is played, and how closely the light follows.
void add_play_options(CLI::App& app, PlayOptions& options)
{
    app.option_defaults()->group(kAnimationGroup);
    app.add_option("--frames", options.frames, "Number of frames")
        ->type_name("N")
        ->default_str("the animation's length")
        ->check(whole(1, kMostFrames));
    app.add_option("--fps", options.fps, "Frames per second of the animation")
        ->type_name("N")
        ->capture_default_str()
        ->check(between(1.0 / kMostFps, kMostFps));
    app.add_option("--animation", options.animation, "Animation of the file by its number, from 0")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMostAnimations));
    add_choice(
        app, "--redistribution", options.redistribution, kRedistributions,
        "How light follows a move: incremental shoots again past the old and the new position, "
        "as exact as a new solution; cross uses only views from what moves, which is faster "
        "where that is small");
    app.add_option(
           "--budget", options.budget_ms,
           "Milliseconds for the light of each frame; where they are not enough it lags behind")
        ->type_name("MS")
        ->default_str("as needed")
        ->check(positive());
    app.add_option_function<double>(
           "--residual", [&options](double percent) { options.residual = percent / 100.0; },
           "Light left to be shot, as a part of all, at which a solution is at rest")
        ->type_name("PERCENT")
        ->default_str(fmt::format("{:g}", 100.0 * options.residual))
        ->check(positive());
    app.add_option("--exposure", options.exposure,
                   "Factor from cd/m2 to brightness, the same for all frames")
        ->type_name("F")
        ->default_str("as suits the first frame")
        ->check(positive());
}

CLI::App& add_play(CLI::App& app, PlayArguments& play, GivenMethod& method)
{
    CLI::App& command = *app.add_subcommand(
        "play", "Render a scene's animation and correct the light from frame to frame");
    PlayOptions& options = play.options;
    command.add_option("scene", play.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    command.add_option("folder", play.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    add_play_options(command, options);
    add_picture_options(command, options.camera, options.width);
    add_atlas_options(command, options.atlas);
    command.option_defaults()->group(kMethodGroup);
    add_one_method(command, method);
    add_device_option(command, options.device);
    add_talk_options(command, play.talk);
    return command;
}

CLI::App& add_reference(CLI::App& app, ReferenceArguments& reference)
{
    CLI::App& command =
        *app.add_subcommand("reference", "Compute the same map by path tracing on the processor");
    command.option_defaults()->group(kMethodGroup);
    command.add_option("scene", reference.scene, "A .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    command.add_option("folder", reference.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    command.add_option("--spp", reference.reference.samples_per_lumel, "Paths per lumel")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kMostPaths));
    command.add_option("--seed", reference.reference.seed, "Random seed")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, std::numeric_limits<std::uint32_t>::max()));
    add_choice(command, "--sampling", reference.reference.rule, kSampleRules,
               "Receive over the covered area of a lumel (the default) or at its centre");
    command.add_flag_callback(
        "--gloss", [&reference] { reference.materials = MaterialModel::glossy; },
        "Include glossy reflection between surfaces, as --solver glossy does");
    add_only_option(command, reference.reference.parts);
    add_light_options(command, reference.options.lights);
    add_atlas_options(command, reference.options.atlas);
    add_sides_option(command, reference.options.atlas);
    add_half_option(command, reference.options.half);
    add_talk_options(command, reference.talk);
    return command;
}

CLI::App& add_info(CLI::App& app, InfoArguments& info, GivenMethod& method)
{
    CLI::App& command =
        *app.add_subcommand("info", "List what is in a scene and what a bake of it would need");
    command.add_option("scene", info.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    add_light_options(command, info.options.lights);
    add_atlas_options(command, info.options.atlas);
    add_sides_option(command, info.options.atlas);
    command.option_defaults()->group(kMethodGroup);
    add_methods(command, method);
    add_directional_option(command, info.options.directional);
    add_json_flag(command, info.json);
    return command;
}

CLI::App& add_compare(CLI::App& app, CompareArguments& compare)
{
    CLI::App& command = *app.add_subcommand("compare", "Measure how far map A is from map B");
    command.option_defaults()->group("Comparison");
    command.add_option("A", compare.map, "The map to measure, an EXR file")
        ->required()
        ->type_name("FILE");
    command.add_option("B", compare.reference, "The map that is taken as right")
        ->required()
        ->type_name("FILE");
    command
        .add_option("-o,--heat-map", compare.heat_map,
                    "PNG to write; white is a difference of 10 % of the mean")
        ->type_name("FILE")
        ->default_str("A-vs-B.png");
    command
        .add_option("--ignore-above", compare.most,
                    "Leave out texels that are brighter than this in B, such as lamps in a picture")
        ->type_name("VALUE")
        ->check(positive());
    add_json_flag(command, compare.json);
    return command;
}

/// What CLI11 did not accept, as one sentence.
std::string complaint(const CLI::App& app, const CLI::ParseError& error)
{
    const auto commands = app.get_subcommands();
    const std::string command =
        commands.empty() ? "lumel" : "lumel " + commands.front()->get_name();
    const std::string advice = "; " + command + " --help lists what there is";
    const std::vector<std::string> extras = app.remaining(true);
    for (const std::string& word : extras)
        if (word.starts_with('-'))
            return fmt::format("{} is not an option of {}{}", word, command, advice);
    if (!extras.empty())
        return commands.empty()
                   ? fmt::format("{} is not a command of {}{}", extras.front(), command, advice)
                   : fmt::format("{} was not expected{}", extras.front(), advice);
    return error.what() + advice;
}

}  // namespace

Arguments parse_arguments(int count, char** values)
{
    CLI::App app("Lumel bakes the light of a glTF scene into lightmaps.", "lumel");
    app.set_version_flag("--version", "lumel " LUMEL_VERSION);
    app.require_subcommand(1);
    app.formatter_fn([](const CLI::App* command, const std::string& path, CLI::AppFormatMode) {
        return help_text(*command, path);
    });

    BakeArguments bake;
    UpdateArguments update;
    RelightArguments relight;
    WhyArguments why;
    RenderArguments render;
    PlayArguments play;
    ReferenceArguments reference;
    InfoArguments info;
    CompareArguments compare;
    DevicesArguments devices;
    GivenMethod bake_method, info_method;
    GivenMethod render_method{.id = method_of(render.options.bake.solver.method).id};
    GivenMethod play_method{.id = method_of(MethodOptions(play.options.solver)).id};
    const CLI::App& bake_command = add_bake(app, bake, bake_method);
    const CLI::App& update_command = add_update(app, update);
    const CLI::App& relight_command = add_relight(app, relight);
    const CLI::App& why_command = add_why(app, why);
    const CLI::App& render_command = add_render(app, render, render_method);
    const CLI::App& play_command = add_play(app, play, play_method);
    const CLI::App& reference_command = add_reference(app, reference);
    const CLI::App& info_command = add_info(app, info, info_method);
    const CLI::App& compare_command = add_compare(app, compare);
    CLI::App& devices_command =
        *app.add_subcommand("devices", "List the Vulkan devices, and why one cannot be used");
    add_json_flag(devices_command, devices.json);
    app.add_subcommand("methods", "List the methods of --solver");
    // For docs/options.md: no group, so that --help does not list it.
    const CLI::App& options_command =
        *app.add_subcommand("options", "Print docs/options.md")->group("");

    for (CLI::App* command : app.get_subcommands({}))
        command->get_help_ptr()->group(kProgramGroup);

    try {
        app.parse(count, values);
    } catch (const CLI::CallForHelp&) {
        return TextArguments{app.help()};
    } catch (const CLI::CallForVersion& version) {
        return TextArguments{std::string(version.what()) + "\n"};
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorKind::input, "", complaint(app, error));
    }

    if (bake_command.parsed()) {
        bake.options.solver.method = bake_method.options();
        check_limits(bake.options.solver);
        return bake;
    }
    if (update_command.parsed())
        return update;
    if (relight_command.parsed())
        return relight;
    if (why_command.parsed())
        return why;
    if (render_command.parsed()) {
        render.options.bake.solver.method = render_method.options();
        check_limits(render.options.bake.solver);
        return render;
    }
    if (play_command.parsed()) {
        play.options.solver = std::get<ProgressiveOptions>(play_method.options());
        return play;
    }
    if (reference_command.parsed())
        return reference;
    if (info_command.parsed()) {
        info.options.solver.method = info_method.options();
        check_limits(info.options.solver);
        return info;
    }
    if (compare_command.parsed())
        return compare;
    if (devices_command.parsed())
        return devices;
    if (options_command.parsed())
        return TextArguments{options_page(app)};
    return MethodsArguments{};
}

}  // namespace lumel
