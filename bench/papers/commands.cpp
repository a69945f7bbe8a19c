#include "bench/papers/commands.h"

#include <string>

#include <CLI/CLI.hpp>

namespace lumel::bench {
namespace {

/// Side of the illumination maps, and of most lightmaps, in [TN11] section 7.
constexpr int kPapersSize = 512;
constexpr const char* kPapersMap = "512";

/// What figures are of that name no other method.
constexpr const char* kMethod = "stochastic";

/// An option of methods, for those of the figure that read it.
void add_given(CLI::App* figure, Settings& shared, const std::string& name)
{
    for (const SharedOption& option : options_of_methods())
        if (name == option.info->name)
            figure
                ->add_option_function<std::string>(
                    "--" + name,
                    [&shared, name](const std::string& value) {
                        shared.given.values[name] = value;
                    },
                    option.info->help)
                ->type_name(option.info->type());
}

CLI::App* add_figure(CLI::App& app, const std::string& name, const std::string& title,
                     Settings& shared)
{
    CLI::App* figure = app.add_subcommand(name, title);
    shared.given.id = kMethod;
    figure->add_option("scene", shared.scene, "glTF scene")->capture_default_str();
    figure->add_option("--device", shared.device, "as lumel devices lists");
    add_given(figure, shared, "hemicube");
    add_given(figure, shared, "projection");
    add_given(figure, shared, "seed");
    return figure;
}

CLI::Option* add_number(CLI::App* figure, const std::string& name, int& value,
                        const std::string& help, int least = 1)
{
    return figure->add_option(name, value, help)
        ->check(CLI::Range(least, 1'000'000))
        ->capture_default_str();
}

CLI::Option* add_list(CLI::App* figure, const std::string& name, std::vector<int>& values,
                      const std::string& help)
{
    return figure->add_option(name, values, help)
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

void add_iterations(CLI::App& app, IterationSettings& settings, Report& report)
{
    CLI::App* figure = add_figure(app, "iterations", "Time of an iteration", settings.shared);
    add_list(figure, "--sizes", settings.sizes, "sides of the map [texels]");
    add_list(figure, "--vertices", settings.vertices, "how many are drawn, about");
    add_number(figure, "--iterations", settings.iterations, "timed at a stretch");
    figure->callback([&settings, &report] { time_iterations(settings, report); });
}

void add_selection(CLI::App& app, SelectionSettings& settings, Report& report)
{
    CLI::App* figure = add_figure(app, "selection", "Time of drawing a shooter", settings.shared);
    add_list(figure, "--sizes", settings.sizes, "sides of the map [texels]");
    add_number(figure, "--draws", settings.draws, "timed at a stretch");
    figure->callback([&settings, &report] { time_selection(settings, report); });
}

void add_convergence(CLI::App& app, ConvergenceSettings& settings, Report& report)
{
    CLI::App* figure = add_figure(app, "convergence", "Error after iterations", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the map [texels]");
    add_list(figure, "--iterations", settings.iterations, "ascending; where the error is taken");
    figure->add_option("--solver", settings.shared.given.id, "as lumel methods lists")
        ->capture_default_str();
    add_given(figure, settings.shared, "batch");
    figure->add_option("--reference", settings.shared.reference,
                       "EXR to compare with, made for this atlas");
    add_number(figure, "--reference-spp", settings.shared.reference_spp,
               "samples of the reference made here; 0: none", 0);
    figure->add_option("--save-reference", settings.shared.save_reference,
                       "EXR to keep that reference in");
    figure->add_option("-o,--out", settings.folder, "folder for maps and pictures");
    add_number(figure, "--width", settings.width, "width of a picture [pixels]");
    figure->callback([&settings, &report] { follow_convergence(settings, report); });
}

void add_visibility(CLI::App& app, VisibilitySettings& settings, Report& report)
{
    CLI::App* figure = add_figure(app, "visibility", "What a shooter sees", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the map [texels]");
    figure->add_option("-o,--out", settings.folder, "folder for the pictures")->required();
    figure->callback([&settings, &report] { show_visibility(settings, report); });
}

void add_glossy_pictures(CLI::App& app, GlossyPicturesSettings& settings, Report& report)
{
    CLI::App* figure = app.add_subcommand("glossy-pictures", "Glossy pictures with their times");
    figure->add_option("--device", settings.shared.device, "as lumel devices lists");
    add_given(figure, settings.shared, "hemicube");
    add_given(figure, settings.shared, "seed");
    add_number(figure, "--size", settings.shared.size, "side of the map [texels]");
    add_number(figure, "--iterations", settings.iterations, "of the solution");
    add_number(figure, "--width", settings.width, "of a picture [pixels]");
    add_number(figure, "--paths", settings.paths, "per pixel, to compare with");
    figure->add_option("-o,--out", settings.folder, "folder for the pictures")->required();
    figure->callback([&settings, &report] { take_glossy_pictures(settings, report); });
}

void add_ablation(CLI::App& app, AblationSettings& settings, Report& report)
{
    settings.shared.scene = "scenes/glossy-cornell-box.gltf";
    CLI::App* figure = add_figure(app, "ablation", "Variance with and without", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the map [texels]");
    add_number(figure, "--seeds", settings.seeds, "runs to take the variance of", 2);
    add_number(figure, "--width", settings.width, "of the picture [pixels]");
    add_number(figure, "--solving-shots", settings.solving_shots, "shooters before an eye looks");
    add_number(figure, "--shots", settings.eye_shots, "shooters for the eye");
    add_number(figure, "--rays", settings.rays, "along the lobe at each place");
    add_number(figure, "--iterations", settings.iterations, "of the papers' scheme, for the disc");
    figure->callback([&settings, &report] { ablate(settings, report); });
}

void add_frames(CLI::App& app, FramesSettings& settings, Report& report)
{
    settings.shared.scene = "scenes/glossy-cornell-box.gltf";
    settings.shared.size = 48;
    settings.shared.reference_spp = 1024;
    CLI::App* figure =
        add_figure(app, "frames", "Frames that have much in common", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the map [texels]");
    add_number(figure, "--frames", settings.frames, "of the film", 2);
    add_number(figure, "--degrees", settings.degrees, "that a thing turns by from frame to frame");
    figure->add_option("--thing", settings.thing, "name of what turns")->capture_default_str();
    add_list(figure, "--iterations", settings.iterations, "of a frame");
    add_number(figure, "--reference-spp", settings.shared.reference_spp,
               "samples of each half of a frame's reference");
    figure->callback([&settings, &report] { follow_frames(settings, report); });
}

void add_layers(CLI::App& app, LayersSettings& settings, Report& report)
{
    settings.shared.scene = "scenes/planes.gltf";
    settings.shared.given.values["map-side"] = kPapersMap;
    CLI::App* figure = add_figure(app, "layers", "What stochastic layers miss", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the lightmap [texels]");
    add_given(figure, settings.shared, "map-side");
    add_number(figure, "--directions", settings.directions, "that light is gathered from");
    add_list(figure, "--overdraw", settings.overdraws, "planes behind one another");
    add_list(figure, "--slabs", settings.slabs, "that they are cut into");
    add_number(figure, "--views", settings.views, "that the chance is taken from");
    add_given(figure, settings.shared, "lookup-test");
    figure->add_option("-o,--out", settings.folder, "folder for the pictures");
    figure->callback([&settings, &report] { measure_layers(settings, report); });
}

void add_leak(CLI::App& app, LeakSettings& settings, Report& report)
{
    settings.shared.scene = "scenes/four-cubes.gltf";
    settings.shared.size = 64;
    CLI::App* figure = add_figure(app, "leak", "How leaky means follow light", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the lightmap [texels]");
    add_given(figure, settings.shared, "map-side");
    figure->add_option("--leak", settings.leak, "part of the solution that a direction replaces")
        ->check(CLI::Range(1e-6, 0.5))
        ->capture_default_str();
    add_list(figure, "--directions", settings.directions,
             "numbers of directions at which the error is taken");
    figure->callback([&settings, &report] { follow_light(settings, report); });
}

void add_directions(CLI::App& app, DirectionsSettings& settings, Report& report)
{
    settings.shared.size = kPapersSize;
    settings.shared.given.values["map-side"] = kPapersMap;
    CLI::App* figure = app.add_subcommand("directions", "Scenes lit by global directions");
    figure->add_option("--device", settings.shared.device, "as lumel devices lists");
    add_given(figure, settings.shared, "seed");
    add_number(figure, "--size", settings.shared.size, "side of the lightmap [texels]");
    add_given(figure, settings.shared, "map-side");
    settings.shared.given.values["slabs"] = "1";  // as the paper
    add_given(figure, settings.shared, "slabs");
    add_given(figure, settings.shared, "lookups");
    figure
        ->add_option("--scenes", settings.scenes,
                     "some of cubes, balls, sky, lamp, landscape, sponza")
        ->delimiter(',')
        ->check(CLI::IsMember({"cubes", "balls", "sky", "lamp", "landscape", "sponza"}));
    add_number(figure, "--directions", settings.directions, "for each scene; 0: as the paper", 0);
    figure->add_option("--sky", settings.sky, "file; else a clear sky");
    figure->add_option(
        "--sponza", settings.sponza,
        "glTF file of one more scene, with 5 x 5 lookups and a lightmap of twice the "
        "side; without it crytek_sponza/sponza.glb in the folder that LUMEL_DATA names");
    figure->add_option("-o,--out", settings.folder, "folder for the picture");
    add_number(figure, "--width", settings.width, "width of each scene's picture [pixels]");
    figure->callback([&settings, &report] { show_directions(settings, report); });
}

void add_residual(CLI::App* figure, double& residual)
{
    figure->add_option("--residual", residual, "light still to be shot, as a part of all, at rest")
        ->check(CLI::Range(1e-6, 1.0))
        ->capture_default_str();
}

/// Of the scenes in which the box turns.
CLI::App* add_moving(CLI::App& app, const char* name, const char* help, DynamicSettings& settings)
{
    CLI::App* figure = app.add_subcommand(name, help);
    figure->add_option("--device", settings.shared.device, "as lumel devices lists");
    figure->add_option("--scenes", settings.scenes, "some of indirect, large, small, low")
        ->delimiter(',')
        ->check(CLI::IsMember({"indirect", "large", "small", "low"}));
    add_number(figure, "--size", settings.shared.size, "side of the map [texels]");
    add_number(figure, "--low-size", settings.low_size, "the same of the low quality scene");
    add_number(figure, "--low-hemicube", settings.low_hemicube, "side of its hemicubes [pixels]");
    add_number(figure, "--low-shooters", settings.low_shooters,
               "its patches send at most 1/N of all light");
    add_given(figure, settings.shared, "hemicube");
    add_given(figure, settings.shared, "batch");
    add_number(figure, "--degrees", settings.degrees, "that the box turns in a step");
    add_residual(figure, settings.residual);
    add_number(figure, "--steps", settings.steps, "after the first, of which the median counts");
    return figure;
}

void add_dynamic(CLI::App& app, DynamicSettings& settings, Report& report)
{
    settings.shared.reference_spp = 1024;
    CLI::App* figure =
        add_moving(app, "dynamic", "A solution is corrected as a box turns", settings);
    add_number(figure, "--reference-spp", settings.shared.reference_spp,
               "paths per lumel for the truth; 0: none", 0);
    figure->add_option("-o,--out", settings.folder, "folder for pictures");
    add_number(figure, "--width", settings.width, "width of a picture [pixels]");
    figure->add_flag("!--no-gather", settings.gathers, "leaves gathering out, which takes longest");
    figure
        ->add_option("--pieces", settings.pieces,
                     "pieces that edges are cut into, for more vertices")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    figure->callback([&settings, &report] { follow_moves(settings, report); });
}

void add_cross_shares(CLI::App& app, DynamicSettings& settings, Report& report)
{
    CLI::App* figure =
        add_moving(app, "cross-shares", "What keeps cross from a solution from scratch", settings);
    figure->callback([&settings, &report] { share_out_cross(settings, report); });
}

void add_drift(CLI::App& app, DriftSettings& settings, Report& report)
{
    settings.shared.scene = "scenes/moving-large-lamp.gltf";
    settings.shared.size = 64;
    CLI::App* figure = add_figure(app, "drift", "What many moves leave", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the map [texels]");
    add_given(figure, settings.shared, "batch");
    add_number(figure, "--degrees", settings.degrees, "that the box turns, there and back");
    add_residual(figure, settings.residual);
    add_number(figure, "--moves", settings.moves, "there and back", 2);
    figure->callback([&settings, &report] { follow_drift(settings, report); });
}

void add_matrix(CLI::App& app, MatrixSettings& settings, Report& report)
{
    CLI::App* figure =
        add_figure(app, "matrix", "Form-factor matrices compressed", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the lightmap [texels]");
    add_list(figure, "--patches", settings.patches, "of the simplified scene, at most");
    add_number(figure, "--lights", settings.lights, "states of light that errors are taken of");
    figure->add_option("--shares", settings.shares, "shares of a row that are kept exactly [%]")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 100.0))
        ->capture_default_str();
    figure->add_option("--forms", settings.forms, "only those whose names have this in them");
    add_number(figure, "--reference-spp", settings.shared.reference_spp,
               "paths per lumel to compare a picture with; 0: none", 0);
    figure->add_option("-o,--out", settings.folder, "folder for pictures");
    add_number(figure, "--width", settings.width, "of the pictures of the scene [pixels]");
    figure->callback([&settings, &report] { compare_matrix_forms(settings, report); });
}

void add_matrix_speed(CLI::App& app, MatrixSpeedSettings& settings, Report& report)
{
    CLI::App* figure =
        add_figure(app, "matrix-speed", "One multiply against many bounces", settings.shared);
    add_number(figure, "--size", settings.shared.size, "side of the lightmap [texels]");
    add_number(figure, "--patches", settings.patches, "of the simplified scene, at most", 8);
    add_list(figure, "--bounces", settings.bounces, "of naive radiosity");
    add_list(figure, "--growth", settings.growth, "patches to compare codes at; none: not");
    add_number(figure, "--large", settings.large, "rows of a matrix of random numbers", 0);
    add_number(figure, "--repeats", settings.repeats, "timed at a stretch");
    figure->callback([&settings, &report] { time_matrices(settings, report); });
}

}  // namespace

void add_figures(CLI::App& app, Figures& figures, Report& report)
{
    add_iterations(app, figures.iterations, report);
    add_selection(app, figures.selection, report);
    add_convergence(app, figures.convergence, report);
    add_visibility(app, figures.visibility, report);
    add_glossy_pictures(app, figures.glossy_pictures, report);
    add_ablation(app, figures.ablation, report);
    add_frames(app, figures.frames, report);
    add_layers(app, figures.layers, report);
    add_leak(app, figures.leak, report);
    add_directions(app, figures.directions, report);
    add_dynamic(app, figures.dynamic, report);
    add_cross_shares(app, figures.cross_shares, report);
    add_drift(app, figures.drift, report);
    add_matrix(app, figures.matrix, report);
    add_matrix_speed(app, figures.matrix_speed, report);
}

void run_figure(const std::vector<std::string>& arguments, Report& report)
{
    Figures figures;
    CLI::App app;
    app.require_subcommand(1);
    add_figures(app, figures, report);
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ParseError& error) {
        throw std::logic_error(arguments.front() + ": " + error.what());
    }
}

}  // namespace lumel::bench
