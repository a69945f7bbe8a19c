// lumel-bench: what the methods cost.

#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/core/huge_pages.h"
#include "bench/modes.h"

namespace lumel::bench {
namespace {

void add_scene(CLI::App& app, Settings& settings)
{
    app.add_option("scene", settings.scene, "glTF scene")->capture_default_str();
    app.add_option("--size", settings.size, "side of the atlas [texels]")
        ->take_last()  // bench/scoreboard gives its own first
        ->capture_default_str();
    app.add_option("--lamp", settings.lamp, "adds a quad that shines down, for unlit scenes")
        ->delimiter(',')
        ->expected(6)
        ->type_name("X,Y,Z,WIDTH,DEPTH,LUX");
    app.add_option("--box", settings.box, "adds a grey box of that name, around a place [m]")
        ->delimiter(',')
        ->expected(6)
        ->type_name("X,Y,Z,WIDTH,HEIGHT,DEPTH");
    app.add_option_function<std::string>(
           "--sky", [&](const std::string& text) { set_sky(settings.lights, text); },
           "light from all directions, as in lumel bake")
        ->type_name("FILE|R,G,B");
    app.add_option_function<std::string>(
           "--sun", [&](const std::string& text) { set_sun(settings.lights, text); },
           "sun, as in lumel bake")
        ->type_name("PLACE");
}

/// What is measured instead of racing.
void add_other_modes(CLI::App& app, Settings& settings)
{
    app.add_option("--growth", settings.growth, "times shooting at these atlas sides instead")
        ->delimiter(',');
    app.add_option(
           "--projections", settings.cuts,
           "compares both projections instead, edges of triangles cut into this number of pieces")
        ->delimiter(',');
    app.add_option("--edits", settings.edits,
                   "times edits of a scene that is kept lit over links instead: dim:LAMP, "
                   "shift:LAMP, paint:MATERIAL, move:THING")
        ->delimiter(',');
    app.add_option("--follow", settings.follow,
                   "times instead how the light follows changes, over kept links and by "
                   "redistribution, each for --seconds at most: dim:LAMP, shift:LAMP, move:THING, "
                   "open:THING")
        ->delimiter(',');
    app.add_option("--moves", settings.moves,
                   "times what rays and close pairs take to follow this thing instead")
        ->type_name("THING");
    app.add_flag("--casters", settings.casters,
                 "times rays that leave lumels instead, and bakes: by the host and by the device");
    app.add_option("--seams", settings.seams,
                   "writes a picture of the map's seams before and after they are matched instead")
        ->type_name("FILE.png");
    app.add_option(
           "--ranks", settings.ranks,
           "predicts instead what a bake takes on up to 1,000 machines, from the reports of "
           "two bakes of a scene: by one process, and by several")
        ->delimiter(',')
        ->type_name("ONE.json,SEVERAL.json");
    app.add_option("--cores", settings.cores, "of each of those machines")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--from", settings.from, "eye of that picture, and what it looks at [m]")
        ->delimiter(',')
        ->expected(6)
        ->type_name("X,Y,Z,X,Y,Z");
    app.add_option("--edit-rays", settings.edit_rays, "rays of a lumel in such a scene")
        ->capture_default_str();
    app.add_option("--edit-truth", settings.edit_truth,
                   "solutions of 256 rays whose mean such a scene's light is compared with");
}

void add_references(CLI::App& app, Settings& settings)
{
    app.add_option("--reference-spp", settings.reference_spp,
                   "samples per lumel of each of the two references; 0: none")
        ->check(CLI::NonNegativeNumber)
        ->take_last()  // the same
        ->capture_default_str();
    app.add_option("--references", settings.references,
                   "keeps the references in files of this name and .1.exr, .2.exr, .guide.exr, and "
                   "reads those that are there")
        ->type_name("NAME");
}

/// An option that takes numbers above 0.
template <class Value>
void add_positive(CLI::App& app, const std::string& name, Value& value, const std::string& help)
{
    app.add_option(name, value, help)
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

void add_race(CLI::App& app, Settings& settings)
{
    app.add_option("--solver", settings.racers,
                   "what races: methods as lumel methods lists; path, a path tracer; prog, "
                   "gathering through the lightmap pass after pass. The other modes take the first")
        ->delimiter(',')
        ->capture_default_str();
    add_positive(app, "--shots", settings.shots,
                 "samples of the methods' rows: rays per lumel, shooters or what else they count");
    add_positive(app, "--spp", settings.spp, "samples per lumel of the rows of path and prog");
    add_positive(app, "--targets", settings.targets,
                 "errors to race to [%]; rows end where all and dark lumels reach the least");
    add_positive(app, "--seconds", settings.seconds,
                 "processor time after which a method has no more rows");
}

void add_method_options(CLI::App& app, Settings& settings)
{
    for (const SharedOption& option : options_of_methods()) {
        const std::string name = option.info->name;
        app.add_option_function<std::string>(
               "--" + name,
               [&settings, name](const std::string& value) { settings.given.values[name] = value; },
               option.info->help)
            ->type_name(option.info->type());
    }
    app.add_option("--sky-directions", settings.sky_directions,
                   "directions from which the light of the sky is gathered")
        ->capture_default_str();
    app.add_option("--near", settings.near_radius,
                   "near field radius [lumel sizes]; 0: as suits the solver")
        ->capture_default_str();
    app.add_option("--device", settings.device, "as lumel devices lists");
}

}  // namespace
}  // namespace lumel::bench

int main(int argc, char** argv)
{
    using namespace lumel::bench;
    lumel::use_huge_pages(argv);
    Settings settings;
    CLI::App app("Error against time for each method, on the same atlas");
    add_scene(app, settings);
    add_race(app, settings);
    add_references(app, settings);
    add_method_options(app, settings);
    add_other_modes(app, settings);
    CLI11_PARSE(app, argc, argv);
    try {
        settings.given.id = first_method(settings);
        if (!settings.cuts.empty())
            compare_projections(settings);
        else if (!settings.edits.empty())
            time_edits(settings);
        else if (!settings.follow.empty())
            time_following(settings);
        else if (!settings.moves.empty())
            time_moves(settings);
        else if (settings.casters)
            time_casters(settings);
        else if (!settings.ranks.empty())
            predict_ranks(settings);
        else if (!settings.seams.empty())
            show_seams(settings);
        else if (!settings.growth.empty())
            grow(settings);
        else
            race(settings);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "lumel-bench: {}\n", error.what());
        return 2;
    }
}
