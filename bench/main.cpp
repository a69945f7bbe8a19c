// lumel-bench: what the methods cost.

#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "bench/modes.h"

int main(int argc, char** argv)
{
    using namespace lumel;
    using namespace lumel::bench;
    Settings settings;
    CLI::App app("Error against time for each method, on the same atlas");
    app.add_option("scene", settings.scene, "glTF scene")->capture_default_str();
    app.add_option("--size", settings.size, "side of the atlas [texels]")->capture_default_str();
    app.add_option("--lamp", settings.lamp, "adds a quad that shines down, for unlit scenes")
        ->delimiter(',')
        ->expected(6)
        ->type_name("X,Y,Z,WIDTH,DEPTH,LUX");
    app.add_option_function<std::string>(
           "--sky", [&](const std::string& text) { set_sky(settings.lights, text); },
           "light from all directions, as in lumel bake")
        ->type_name("FILE|R,G,B");
    app.add_option_function<std::string>(
           "--sun", [&](const std::string& text) { set_sun(settings.lights, text); },
           "sun, as in lumel bake")
        ->type_name("PLACE");
    app.add_option("--sky-directions", settings.sky_directions,
                   "directions from which the light of the sky is gathered")
        ->capture_default_str();
    app.add_option("--growth", settings.growth, "times shooting at these atlas sides instead")
        ->delimiter(',');
    app.add_option("--reference", settings.reference, "EXR to compare with, made for this atlas");
    app.add_option("--reference-spp", settings.reference_spp,
                   "samples of the reference made here; 0: none")
        ->capture_default_str();
    app.add_option("--save-reference", settings.save_reference, "EXR to keep that reference in");
    app.add_option("--shots", settings.shots, "numbers of shooters at which the error is measured")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--spp", settings.spp, "samples per lumel of the path tracer's rows")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--solver", settings.given.id, "as lumel methods lists")->capture_default_str();
    for (const SharedOption& option : options_of_methods()) {
        const std::string name = option.info->name;
        app.add_option_function<std::string>(
               "--" + name,
               [&settings, name](const std::string& value) { settings.given.values[name] = value; },
               option.info->help)
            ->type_name(option.info->type);
    }
    app.add_option(
           "--projections", settings.cuts,
           "compares both projections instead, edges of triangles cut into this number of pieces")
        ->delimiter(',');
    app.add_option("--near", settings.near_radius,
                   "near field radius [lumel sizes]; 0: as suits the solver")
        ->capture_default_str();
    app.add_option("--device", settings.device, "as lumel devices lists");
    app.add_option("--target", settings.target, "relative RMSE to race to")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        settings.given.options();  // what is wrong is said before the long work
        if (!settings.cuts.empty())
            compare_projections(settings);
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
