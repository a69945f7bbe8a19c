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

namespace lumel {
namespace {

constexpr int kLargestAtlas = 16384;  // the largest image side that common devices offer [texels]
constexpr int kLargestHemicube = 2048;
constexpr int kSmallestMap = 16, kLargestMap = 4096;
constexpr int kLargestBatch = 256;
constexpr int kLargestGutter = 64;
constexpr int kMostShots = 2'000'000'000;
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
const Choices<Projection> kProjections = {{"hemicube", Projection::hemicube},
                                          {"hemisphere", Projection::hemisphere}};
const Choices<Directional> kDirectional = {{"sh1", Directional::sh1}, {"sh2", Directional::sh2}};
const Choices<Parts> kParts = {{"direct", Parts::direct}, {"indirect", Parts::indirect}};
const Choices<Layers> kLayers = {
    {"list", Layers::list}, {"peel", Layers::peel}, {"stochastic", Layers::stochastic}};
constexpr const char* kAsNeeded = "auto";
const Choices<int> kLookups = {{"1", 1}, {"3", 3}, {"5", 5}};
const Choices<Redistribution> kRedistributions = {{"incremental", Redistribution::incremental},
                                                  {"cross", Redistribution::cross}};
const Choices<Scheme> kSchemes = {{"phased", Scheme::phased}, {"paper", Scheme::paper}};

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
    for (const auto& choice : choices)
        words.push_back(choice.first);
    return app.add_option_function<std::string>(name, assign, help)
        ->type_name(CLI::detail::join(words, "|"))
        ->check([words](const std::string& word) -> std::string {
            if (std::find(words.begin(), words.end(), word) != words.end())
                return {};
            return fmt::format("'{}' is none of {}", word, CLI::detail::join(words, ", "));
        });
}

void add_view_options(CLI::App& app, SolverOptions& solver)
{
    app.add_option("--batch", solver.batch, "Shooters per iteration")
        ->type_name("K")
        ->capture_default_str()
        ->check(whole(1, kLargestBatch));
    add_choice(app, "--projection", solver.projection, kProjections,
               "What shooters see is drawn on five faces (hemicube, the default) or on one disc");
    app.add_option(
           "--hemicube", solver.hemicube,
           "Side of a hemicube's front face in pixels; a hemisphere's disc is twice as wide")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(16, kLargestHemicube));
}

void add_map_options(CLI::App& app, SolverOptions& solver)
{
    add_choice(app, "--layers", solver.layers, kLayers,
               "What --solver directions keeps of surfaces behind one another: all of them, at "
               "once (list, the default) or one after another (peel), or one a pixel by chance "
               "(stochastic)");
    add_choice(app, "--lookups", solver.lookups, kLookups,
               "Side of the square of pixels looked up among stochastic layers (default: 3)");
    app.add_option_function<std::string>(
           "--slabs",
           [&solver](const std::string& text) {
               solver.slabs = text == kAsNeeded ? 0 : std::uint32_t(std::stoul(text));
           },
           "Slabs that each direction is cut into, so that fewer surfaces compete for a pixel of "
           "stochastic layers; auto (the default): as many as the overdraw asks for")
        ->type_name("auto|N")
        ->check(CLI::IsMember({kAsNeeded}) | whole(1, kMostSlabs));
    app.add_option("--map-side", solver.map_side,
                   "Side of --solver directions' maps in pixels (default: as suits the lumels)")
        ->type_name("N")
        ->check(whole(kSmallestMap, kLargestMap));
}

void add_matrix_options(CLI::App& app, SolverOptions& solver)
{
    app.add_option("--patches", solver.patches, "Patches of --solver matrix, at most")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(kFewestPatches, kMostPatches));
    app.add_option("--bounces", solver.bounces,
                   "Reflections that --solver matrix counts (default: all)")
        ->type_name("K")
        ->check(whole(1, kMostBounces));
}

void add_atlas_options(CLI::App& app, AtlasOptions& atlas)
{
    app.add_option("--texels-per-metre", atlas.texels_per_metre, "Density of the lightmap")
        ->type_name("N")
        ->check(positive());
    app.add_option("--size", atlas.size, "Side of the square atlas in texels, instead of a density")
        ->type_name("N")
        ->check(whole(1, kLargestAtlas));
    app.add_option("--max-size", atlas.max_size,
                   "Largest side allowed; the density is scaled to fit")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kLargestAtlas));
    app.add_option("--gutter", atlas.gutter, "Empty texels kept around each chart")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kLargestGutter));
}

/// Light from outside, and what lamps are like.
void add_light_options(CLI::App& app, LightOptions& lights)
{
    app.add_option_function<std::string>(
           "--sky", [&lights](const std::string& text) { set_sky(lights, text); },
           "Light from all around: an .exr or .hdr image in cd/m2, +x at its centre, or one colour")
        ->type_name("FILE|R,G,B");
    app.add_option("--sky-scale", lights.sky_scale, "Factor to the light of the sky")
        ->type_name("F")
        ->check(positive());
    app.add_option_function<double>(
           "--sky-rotation",
           [&lights](double degrees) { lights.sky_rotation = glm::radians(degrees); },
           "Turn the sky, and --sun, about +y, counter-clockwise as seen from above")
        ->type_name("DEGREES")
        ->check(between(-kMostDegrees, kMostDegrees));
    app.add_option_function<std::string>(
           "--sun", [&lights](const std::string& text) { set_sun(lights, text); },
           "Sun, and without --sky a clear sky: AZIMUTH (clockwise from north, which is -z), "
           "ELEVATION in degrees, or LATITUDE,LONGITUDE,DATETIME such as "
           "47.5,19.0,2024-06-21T12:00:00Z")
        ->type_name("PLACE");
    app.add_option_function<double>(
           "--sun-angle",
           [&lights](double degrees) { lights.sun_angle = float(glm::radians(degrees)); },
           "Half the angle of the sun's disc, and of directional lights that have none "
           "(default: 0.2665 for --sun)")
        ->type_name("DEGREES")
        ->check(between(0.0, kLargestSunAngle));
    app.add_option("--light-radius", lights.light_radius,
                   "Radius of point and spot lights that have none")
        ->type_name("METRES")
        ->check(positive());
    app.add_option_function<std::vector<std::string>>(
           "--ies",
           [&lights](const std::vector<std::string>& texts) {
               for (const std::string& text : texts)
                   add_profile(lights, text);
           },
           "IES photometric file for the point or spot lights of a name; may be repeated")
        ->type_name("LIGHT=FILE")
        ->allow_extra_args(false);  // one at a time, so that a scene may follow
}

void add_talk_options(CLI::App& app, Talk& talk)
{
    app.add_flag("-q,--quiet", talk.quiet, "Say nothing but warnings and errors");
    app.add_flag("--json", talk.json, "Print the report as JSON on stdout, and nothing else");
    app.add_flag_callback(
        "--no-progress", [&talk] { talk.progress = false; }, "Draw no progress line");
}

void add_method_options(CLI::App& app, SolverOptions& solver)
{
    Choices<std::string> methods;
    for (const MethodInfo& method : kMethods)
        methods.emplace_back(method.id, method.id);
    const std::string title = "Method; lumel methods lists them";
    app.add_option("--solver", solver.method, title)
        ->type_name("NAME")
        ->capture_default_str()
        ->check([methods](const std::string& word) -> std::string {
            for (const auto& method : methods)
                if (method.first == word)
                    return {};
            return fmt::format("'{}' is not in the list of lumel methods", word);
        });
    add_choice(app, "--scheme", solver.scheme, kSchemes,
               "Iteration scheme: phased (exact near pairs, the default) or the papers'");
}

void add_solver_options(CLI::App& app, SolverOptions& solver)
{
    add_choice(app, "--sampling", solver.rule, kSampleRules,
               "Receive over the covered area of a lumel (the default) or at its centre");
    app.add_option("--seed", solver.seed, "Of all random numbers")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, std::numeric_limits<std::uint32_t>::max()));
    add_view_options(app, solver);
}

/// When to stop. Without any of the three the bake ends at the default error.
void add_stop_options(CLI::App& app, SolverOptions& solver)
{
    auto* shots = app.add_option("--shots", solver.max_shots, "Stop after this many shooters")
                      ->type_name("N")
                      ->check(whole(1, kMostShots));
    auto* time = app.add_option("--time", solver.max_seconds, "Stop after this long solving")
                     ->type_name("SECONDS")
                     ->check(positive());
    auto* error = app.add_option_function<double>(
        "--error", [&solver](double percent) { solver.target_error = percent / 100.0; },
        fmt::format(
            "Stop at this estimated error (default: {:g}, or none beside --shots or --time)",
            100.0 * solver.target_error));
    error->type_name("PERCENT")->check(positive());
    app.callback([&solver, shots, time, error] {
        if (error->empty() && !(shots->empty() && time->empty()))
            solver.target_error = 0.0;
    });
}

void add_sky_directions_option(CLI::App& app, BakeOptions& options)
{
    app.add_option("--sky-directions", options.sky_directions,
                   "How many directions the light of the sky is taken from")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(2, kMostDirections));
}

void add_directional_option(CLI::App& app, Directional& directional)
{
    add_choice(app, "--directional", directional, kDirectional,
               "Also write where the light comes from, as spherical harmonics of order 1 or 2");
}

void add_device_option(CLI::App& app, std::string& device)
{
    app.add_option("--device", device, "Index or part of a name from lumel devices")
        ->type_name("NAME");
}

void add_preview_option(CLI::App& app, int& width)
{
    app.add_option("--preview-width", width, "Of preview.png; 0: none")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kLargestAtlas));
}

CLI::App& add_bake(CLI::App& app, BakeArguments& bake)
{
    CLI::App& command = *app.add_subcommand("bake", "Solve the light of a scene into lightmaps");
    command.add_option("scene", bake.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    command.add_option("folder", bake.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    add_light_options(command, bake.options.lights);
    add_sky_directions_option(command, bake.options);
    add_atlas_options(command, bake.options.atlas);
    add_method_options(command, bake.options.solver);
    add_solver_options(command, bake.options.solver);
    add_map_options(command, bake.options.solver);
    add_matrix_options(command, bake.options.solver);
    add_stop_options(command, bake.options.solver);
    add_device_option(command, bake.options.device);
    command.add_flag("--half", bake.options.half, "Write lightmap.exr in half precision");
    add_choice(command, "--only", bake.options.parts, kParts,
               "Of the arriving light only what comes straight from its source, or only the rest");
    add_directional_option(command, bake.options.directional);
    add_preview_option(command, bake.options.preview_width);
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
            fmt::format("Error of the correction to stop at, of all light (default: {:g})",
                        100.0 * options.residual))
        ->type_name("PERCENT")
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
        "relight", "Light a bake of --solver matrix anew: any states of its lights, at once");
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
    auto* lumel = app.add_option_function<std::vector<double>>(
                         "--lumel",
                         [&options](const std::vector<double>& uv) {
                             options.place = {uv[0], uv[1]};
                         },
                         "Place in the lightmap as TEXCOORD_1 has it, from 0,0 at its top left "
                         "corner to 1,1")
                      ->type_name("U,V")
                      ->delimiter(',')
                      ->expected(2)
                      ->check(between(0.0, 1.0));
    auto* texel =
        app.add_option_function<std::vector<int>>(
               "--texel",
               [&options](const std::vector<int>& at) { options.texel = glm::ivec2(at[0], at[1]); },
               "The same as column and row of texels, from 0,0")
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
        "why", "Say what sends light to a place of a baked lightmap, and show it in why.png");
    command.add_option("folder", why.folder, "What lumel bake wrote")
        ->required()
        ->type_name("FOLDER");
    add_place_options(command, why.options);
    command.add_option("--width", why.options.width, "Of why.png in pixels; 0: none")
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
    app.add_option("--camera", camera,
                   "Number of the file's camera, from 0 (default: the first, or one chosen)")
        ->type_name("N")
        ->check(whole(0, kMostCameras));
    app.add_option("--width", width, "Of a picture in pixels")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kLargestAtlas));
}

CLI::App& add_render(CLI::App& app, RenderArguments& render)
{
    CLI::App& command = *app.add_subcommand(
        "render", "Solve the light of a scene, gloss and all, and show it to a camera");
    RenderOptions& options = render.options;
    command.add_option("scene", render.scene, "A .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    command.add_option("picture", render.picture, "PNG, or EXR of radiance in cd/m2")
        ->required()
        ->type_name("FILE");
    add_picture_options(command, options.camera, options.width);
    command.add_option("--height", options.height, "Of the picture (default: as the camera says)")
        ->type_name("N")
        ->check(whole(1, kLargestAtlas));
    command.add_option("--places", options.sets, "Places looked at within each pixel")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kMostPlaces));
    command.add_option("--eye-shots", options.shots, "Shooters for glossy reflections in view")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMostShots));
    command.add_option("--lobe-rays", options.rays, "Rays along the lobe at each place")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMostRays));
    command
        .add_option("--paths", options.paths,
                    "Trace this many paths per pixel on the CPU instead, to compare with")
        ->type_name("N")
        ->check(whole(1, kMostPaths));
    add_light_options(command, options.bake.lights);
    add_sky_directions_option(command, options.bake);
    add_atlas_options(command, options.bake.atlas);
    add_solver_options(command, options.bake.solver);
    add_stop_options(command, options.bake.solver);
    add_device_option(command, options.bake.device);
    add_talk_options(command, render.talk);
    return command;
}

/// What is played, and how closely the light follows.
void add_play_options(CLI::App& app, PlayOptions& options)
{
    app.add_option("--frames", options.frames, "Pictures to make (default: the animation's length)")
        ->type_name("N")
        ->check(whole(1, kMostFrames));
    app.add_option("--fps", options.fps, "Pictures for each second of the animation")
        ->type_name("N")
        ->capture_default_str()
        ->check(between(1.0 / kMostFps, kMostFps));
    app.add_option("--animation", options.animation, "Number of the file's animation, from 0")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMostAnimations));
    add_choice(app, "--redistribution", options.redistribution, kRedistributions,
               "How light follows what moves: everything looks anew where it must (incremental, "
               "the default), or only what moves looks (cross)");
    app.add_option("--budget", options.budget_ms,
                   "Milliseconds that the light of each picture may take (default: as it needs)")
        ->type_name("MS")
        ->check(positive());
    app.add_option_function<double>(
           "--residual", [&options](double percent) { options.residual = percent / 100.0; },
           fmt::format("Light left to be shot at which it is at rest (default: {:g})",
                       100.0 * options.residual))
        ->type_name("PERCENT")
        ->check(positive());
    app.add_option("--exposure", options.exposure,
                   "Factor from cd/m2 to the pictures' brightness (default: as suits the first)")
        ->type_name("F")
        ->check(positive());
}

CLI::App& add_play(CLI::App& app, PlayArguments& play)
{
    CLI::App& command = *app.add_subcommand(
        "play", "Show a scene's animation, its light corrected from picture to picture");
    PlayOptions& options = play.options;
    command.add_option("scene", play.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    command.add_option("folder", play.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    add_play_options(command, options);
    add_picture_options(command, options.camera, options.width);
    add_atlas_options(command, options.atlas);
    add_view_options(command, options.solver);
    add_device_option(command, options.device);
    add_talk_options(command, play.talk);
    return command;
}

CLI::App& add_reference(CLI::App& app, ReferenceArguments& reference)
{
    CLI::App& command =
        *app.add_subcommand("reference", "Compute the same map by path tracing on the CPU");
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
    command.add_option("--seed", reference.reference.seed, "Of all random numbers")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, std::numeric_limits<std::uint32_t>::max()));
    add_choice(command, "--sampling", reference.reference.rule, kSampleRules,
               "Receive over the covered area of a lumel (the default) or at its centre");
    command.add_flag_callback(
        "--gloss", [&reference] { reference.materials = MaterialModel::glossy; },
        "Pass light on by glossy reflection too, as --solver glossy does");
    add_choice(command, "--only", reference.reference.parts, kParts,
               "Of the arriving light only what comes straight from its source, or only the rest");
    add_light_options(command, reference.options.lights);
    add_atlas_options(command, reference.options.atlas);
    command.add_flag("--half", reference.options.half, "Write lightmap.exr in half precision");
    add_talk_options(command, reference.talk);
    return command;
}

CLI::App& add_info(CLI::App& app, InfoArguments& info)
{
    CLI::App& command =
        *app.add_subcommand("info", "Say what is in a scene and what a bake would take");
    command.add_option("scene", info.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    add_light_options(command, info.options.lights);
    add_atlas_options(command, info.options.atlas);
    add_method_options(command, info.options.solver);
    add_view_options(command, info.options.solver);
    add_directional_option(command, info.options.directional);
    command.add_flag("--json", info.json, "Print JSON");
    return command;
}

CLI::App& add_compare(CLI::App& app, CompareArguments& compare)
{
    CLI::App& command = *app.add_subcommand("compare", "Measure how far map A is from map B");
    command.add_option("A", compare.map, "The map to judge, an EXR file")
        ->required()
        ->type_name("FILE");
    command.add_option("B", compare.reference, "The map taken as the truth")
        ->required()
        ->type_name("FILE");
    command.add_option("-o,--heat-map", compare.heat_map, "PNG to write (default: A-vs-B.png)")
        ->type_name("FILE");
    command
        .add_option("--ignore-above", compare.most,
                    "Leave out what is brighter than this in B, such as lamps in a picture")
        ->type_name("VALUE")
        ->check(positive());
    command.add_flag("--json", compare.json, "Print JSON");
    return command;
}

/// Throws for options that would do nothing.
void check_map_options(const CLI::App& command, const SolverOptions& solver)
{
    const auto require = [&](const char* option, bool used, const char* with) {
        if (command.count(option) > 0 && !used)
            throw Error(ErrorKind::input, option, std::string("does nothing without ") + with);
    };
    for (const char* option : {"--layers", "--lookups", "--slabs", "--map-side"})
        require(option, solver.method == "directions", "--solver directions");
    for (const char* option : {"--lookups", "--slabs"})
        require(option, solver.layers == Layers::stochastic, "--layers stochastic");
    if (solver.method == "gather" && solver.projection != Projection::hemicube)
        throw Error(ErrorKind::input, "--projection",
                    "must be hemicube with --solver gather, which knows no other");
}

/// What CLI11 did not accept, as one sentence.
std::string complaint(const CLI::App& app, const CLI::ParseError& error)
{
    const auto commands = app.get_subcommands();
    const std::string command =
        commands.empty() ? "lumel" : "lumel " + commands.front()->get_name();
    const std::string advice = "; " + command + " --help shows what there is";
    const std::vector<std::string> extras = app.remaining(true);
    for (const std::string& word : extras)
        if (word.starts_with('-'))
            return fmt::format("{} is no option of {}{}", word, command, advice);
    if (!extras.empty())
        return commands.empty()
                   ? fmt::format("{} is no command of {}{}", extras.front(), command, advice)
                   : fmt::format("{} was not expected{}", extras.front(), advice);
    return error.what() + advice;
}

}  // namespace

Arguments parse_arguments(int count, char** values)
{
    CLI::App app("Lumel bakes the light of a glTF scene into lightmaps.", "lumel");
    app.set_version_flag("--version", "lumel " LUMEL_VERSION);
    app.require_subcommand(1);

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
    const CLI::App& bake_command = add_bake(app, bake);
    const CLI::App& update_command = add_update(app, update);
    const CLI::App& relight_command = add_relight(app, relight);
    const CLI::App& why_command = add_why(app, why);
    const CLI::App& render_command = add_render(app, render);
    const CLI::App& play_command = add_play(app, play);
    const CLI::App& reference_command = add_reference(app, reference);
    const CLI::App& info_command = add_info(app, info);
    const CLI::App& compare_command = add_compare(app, compare);
    CLI::App& devices_command = *app.add_subcommand("devices", "List what Vulkan offers");
    devices_command.add_flag("--json", devices.json, "Print JSON");
    app.add_subcommand("methods", "List the solvers");

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
        check_map_options(bake_command, bake.options.solver);
        return bake;
    }
    if (update_command.parsed())
        return update;
    if (relight_command.parsed())
        return relight;
    if (why_command.parsed())
        return why;
    if (render_command.parsed())
        return render;
    if (play_command.parsed())
        return play;
    if (reference_command.parsed())
        return reference;
    if (info_command.parsed())
        return info;
    if (compare_command.parsed())
        return compare;
    if (devices_command.parsed())
        return devices;
    return MethodsArguments{};
}

}  // namespace lumel
