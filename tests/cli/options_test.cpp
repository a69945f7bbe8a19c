// What the command line accepts, and its messages for what it does not.

#include <sstream>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "program.h"

namespace lumel::test {
namespace {

struct BadLine {
    std::vector<std::string> arguments;
    std::vector<std::string> words;  ///< the sentence must hold them
};

TEST(Options, EveryMistakeIsOneSentenceAndExitCode2)
{
    const std::string scene = own_scene("cornell-box.gltf");
    const BadLine lines[] = {
        {{}, {"no command given", "--help"}},
        {{"frobnicate"}, {"frobnicate", "--help"}},
        {{"bak"}, {"did you mean bake?"}},
        {{"comapre"}, {"did you mean compare?"}},
        {{"help", "rendr"}, {"did you mean render?"}},
        {{"completion", "fish"}, {"fish", "bash, zsh"}},
        {{"bake"}, {"scene"}},
        {{"report"}, {"folder"}},
        {{"report", "one", "two", "three"}, {"three"}},
        {{"bake", scene}, {"folder"}},
        {{"bake", scene, "out", "more"}, {"more"}},
        {{"bake", scene, "out", "--siz", "32"}, {"did you mean --size?"}},
        {{"bake", scene, "out", "--siez=32"}, {"did you mean --size?"}},
        {{"bake", scene, "out", "--magic"}, {"--magic", "lumel bake --help"}},
        {{"bake", scene, "out", "--size"}, {"--size"}},
        {{"bake", scene, "out", "--size", "0"}, {"--size", "0"}},
        {{"bake", scene, "out", "--size", "nan"}, {"--size", "nan"}},
        {{"bake", scene, "out", "--size", "3.5"}, {"--size", "3.5"}},
        {{"bake", scene, "out", "--size", "010"},
         {"--size", "010"}},  // octal to the parser of options
        {{"bake", scene, "out", "--shots", "0"}, {"--shots"}},
        {{"bake", scene, "out", "--shots", "1e99"}, {"--shots"}},
        {{"bake", scene, "out", "--time", "-1"}, {"--time"}},
        {{"bake", scene, "out", "--time", "inf"}, {"--time"}},
        {{"bake", scene, "out", "--error", "0"}, {"--error"}},
        {{"bake", scene, "out", "--texels-per-metre", "nan"}, {"--texels-per-metre"}},
        {{"bake", scene, "out", "--seed", "-1"}, {"--seed"}},
        {{"bake", scene, "out", "--seed", "4294967296"}, {"--seed"}},
        {{"bake", scene, "out", "--solver", "mc"},
         {"--solver", "mc", "links", "stochastic", "matrix"}},
        {{"bake", scene, "out", "--solver", "stochastic", "--batch", "257"}, {"--batch", "257"}},
        {{"bake", scene, "out", "--solver", "glossy", "--batch", "129"}, {"--batch 129", "128"}},
        {{"render", scene, "out.png", "--batch", "129"}, {"--batch 129", "128"}},
        {{"bake", scene, "out", "--layers", "peel"}, {"--layers", "--solver directions"}},
        {{"bake", scene, "out", "--lookups", "5"}, {"--lookups", "--solver directions"}},
        {{"bake", scene, "out", "--solver", "directions", "--lookups", "5"},
         {"--lookups", "--layers stochastic"}},
        {{"bake", scene, "out", "--solver", "directions", "--slabs", "4"},
         {"--slabs", "--layers stochastic"}},
        {{"bake", scene, "out", "--solver", "directions", "--layers", "stochastic", "--slabs", "0"},
         {"--slabs"}},
        {{"bake", scene, "out", "--solver", "glossy", "--map-side", "64"},
         {"--map-side", "--solver directions"}},
        {{"bake", scene, "out", "--solver", "gather", "--projection", "hemisphere"},
         {"--projection", "--solver gather"}},
        {{"bake", scene, "out", "--quiet", "--verbose"}, {"--verbose", "--quiet"}},
        {{"render", scene, "out.png", "--paths", "4", "--dump", "inside"}, {"--dump", "--paths"}},
        {{"bake", scene, "out", "--batch", "16"}, {"--batch", "--solver links", "stochastic"}},
        {{"bake", scene, "out", "--solver", "stochastic", "--dark-error", "5"},
         {"--dark-error", "--solver stochastic"}},
        {{"bake", scene, "out", "--solver", "stochastic", "--scheme", "magic"},
         {"--scheme", "magic", "paper"}},
        {{"bake", scene, "out", "--sampling", "corner"}, {"--sampling", "corner", "centre"}},
        {{"bake", scene, "out", "--solver", "stochastic", "--projection", "sphere"},
         {"--projection", "sphere", "hemisphere"}},
        {{"bake", scene, "out", "--directional", "sh3"}, {"--directional", "sh3", "sh2"}},
        {{"bake", scene, "out", "--directional"}, {"--directional"}},
        {{"reference", scene, "out", "--directional", "sh1"}, {"--directional"}},
        {{"reference", scene, "out", "--spp", "0"}, {"--spp"}},
        {{"info", scene, "--sky", "absent.hdr"}, {"absent.hdr", "no such file"}},
        {{"info", scene, "--sky", "1,2"}, {"--sky", "1,2"}},
        {{"info", scene, "--sun", "400,20"}, {"--sun", "azimuth", "360"}},
        {{"info", scene, "--sky", "cie:12@400,20"}, {"--sky", "cie:12@400,20"}},
        {{"info", scene, "--sky", "nan"}, {"--sky", "nan", "R,G,B", "overcast"}},
        {{"info", scene, "--sky", "1e400,1,1"}, {"--sky", "1e400,1,1", "R,G,B"}},
        {{"info", scene, "--sky", "sky.png"}, {"--sky", "sky.png", ".exr"}},
        {{"info", scene, "--sun", "nan,20"}, {"--sun", "nan,20", "ELEVATION"}},
        {{"info", scene, "--sky-scale", "0"}, {"--sky-scale"}},
        {{"info", scene, "--ground", "2"}, {"--ground"}},
        {{"info", scene, "--sky-rotation", "nan"}, {"--sky-rotation"}},
        {{"info", scene, "--sun", "noon"}, {"--sun", "noon", "ELEVATION"}},
        {{"info", scene, "--sun", "47,19,yesterday"}, {"yesterday", "UTC"}},
        {{"info", scene, "--sun-angle", "50"}, {"--sun-angle", "50"}},
        {{"info", scene, "--light-radius", "-1"}, {"--light-radius"}},
        {{"info", scene, "--ies", "lamp"}, {"--ies", "LIGHT=FILE"}},
        {{"info", scene, "--ies", "lamp=file.ies"}, {"--ies", "lamp"}},
        {{"reference", scene, "out", "--only", "some"}, {"--only", "some", "indirect"}},
        {{"probes", "out", "--spacing", "0"}, {"--spacing"}},
        {{"probes", "out", "--bounds", "0,0,0,1,1,1"}, {"--bounds", "--spacing"}},
        {{"probes", "out", "--spacing", "1", "--bounds", "0,0,0,1,1,0"}, {"--bounds", "Z0 < Z1"}},
        {{"probes", "out", "--at", "1,2"}, {"--at", "X,Y,Z"}},
        {{"compare", "one.exr"}, {"B"}},
        {{"info"}, {"scene"}},
    };
    for (const BadLine& line : lines) {
        SCOPED_TRACE(testing::PrintToString(line.arguments));
        expect_one_sentence(run_lumel(line.arguments), 2, line.words);
    }
}

TEST(Options, LightsMayBeNegativeNumbersAndRepeated)
{
    const std::string scene = own_scene("cornell-box.gltf");
    const Outcome sun = run_lumel({"info", scene, "--sun", "-30,45", "--sky-rotation", "-10"});
    EXPECT_EQ(sun.code, 0) << sun.err;
    EXPECT_NE(sun.out.find("lx on an open plane"), std::string::npos) << sun.out;
    expect_one_sentence(run_lumel({"info", "--ies", "a=1.ies", "--ies", "b=2.ies", scene}), 2,
                        {"\"a\""});
}

TEST(Options, HelpAndVersionGoToStdoutAndSucceed)
{
    for (const char* option : {"--version", "-V"}) {
        const Outcome version = run_lumel({option});
        EXPECT_EQ(version.code, 0);
        EXPECT_EQ(version.out.rfind("lumel ", 0), 0u);
        EXPECT_EQ(version.err, "");
    }
    const Outcome help = run_lumel({"bake", "-h"});
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(run_lumel({"help", "bake"}).out, help.out);
    EXPECT_EQ(run_lumel({"help"}).out, run_lumel({"--help"}).out);
    for (const char* option :
         {"--texels-per-metre", "--size", "--shots", "--time", "--error", "--json"})
        EXPECT_NE(help.out.find(option), std::string::npos) << option;
}

TEST(Options, OptionsPageIsWhatTheProgramPrints)
{
    const Outcome page = run_lumel({"options"});
    EXPECT_EQ(page.code, 0) << page.err;
    EXPECT_TRUE(page.out == bytes_of(support::source_path("docs/options.md")))
        << "print it again: lumel options > docs/options.md";
}

TEST(Options, OptionsPageHoldsEveryOptionThatHelpLists)
{
    const std::string page = run_lumel({"options"}).out;
    for (const char* command :
         {"bake", "update", "relight", "why", "measure", "probes", "render", "play", "reference",
          "info", "compare", "devices", "methods", "help", "man", "completion"}) {
        const std::string help = run_lumel({command, "--help"}).out;
        for (std::size_t at = help.find("\n  --"); at != std::string::npos;
             at = help.find("\n  --", at + 1)) {
            const std::size_t name = at + 3;
            const std::string option = help.substr(name, help.find_first_of(" \n", name) - name);
            EXPECT_NE(page.find("`" + option), std::string::npos) << option << " of " << command;
        }
    }
}

TEST(Options, HelpFitsHundredColumns)
{
    std::istringstream help(run_lumel({"bake", "--help"}).out);
    for (std::string line; std::getline(help, line);)
        EXPECT_LE(line.size(), 100u) << line;
}

TEST(Options, MethodsListsTheDefaultSolver)
{
    const Outcome methods = run_lumel({"methods"});
    EXPECT_EQ(methods.code, 0);
    EXPECT_NE(methods.out.find("stochastic"), std::string::npos);
}

}  // namespace
}  // namespace lumel::test
