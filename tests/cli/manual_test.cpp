// What the program prints of itself: its manual page, and what completes its options in a shell.

#include <array>
#include <cstdio>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "program.h"

namespace lumel::test {
namespace {

const std::array kCommands = {"bake",    "update",  "relight", "why",  "measure",   "probes",
                              "report",  "render",  "play",    "view", "reference", "info",
                              "compare", "devices", "methods", "help", "man",       "completion"};

/// What a shell command prints on both of its streams, and how it ends.
Outcome run_shell(const std::string& command)
{
    Outcome outcome;
    FILE* stream = popen(("{ " + command + "\n} 2>&1").c_str(), "r");
    std::array<char, 4096> buffer;
    while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), stream))
        outcome.out.append(buffer.data(), count);
    outcome.code = pclose(stream);
    return outcome;
}

bool is_installed(const std::string& program)
{
    return run_shell("command -v " + program).code == 0;
}

/// Names of the options that --help lists: "-q", "--quiet".
std::set<std::string> options_in_help(const std::string& command)
{
    std::set<std::string> options;
    std::istringstream help(run_lumel({command, "--help"}).out);
    for (std::string line; std::getline(help, line);) {
        if (!line.starts_with("  -"))
            continue;
        std::istringstream words(line);
        for (std::string word; words >> word && word.starts_with('-');)
            options.insert(word.ends_with(',') ? word.substr(0, word.size() - 1) : word);
    }
    return options;
}

/// What bash offers for the last of `words`, by the script at `path`.
std::set<std::string> completed_by_bash(const std::string& path, const std::string& words)
{
    const Outcome shell = run_shell("bash -c 'compopt() { echo \"<$*>\"; }; source \"" + path +
                                    "\"; COMP_WORDS=(" + words +
                                    "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _lumel; "
                                    "printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
    std::set<std::string> offers;
    std::istringstream lines(shell.out);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty())
            offers.insert(line);
    return offers;
}

using Words = std::set<std::string>;

TEST(Manual, PageIsWhatTheFormatterTakesWithoutAWarning)
{
    if (!is_installed("groff"))
        GTEST_SKIP() << "groff is not installed";
    const Workplace place;
    const std::string page = place.file("lumel.1", run_lumel({"man"}).out);
    const Outcome groff = run_shell("groff -ww -man -Tutf8 -z '" + page + "'");
    EXPECT_EQ(groff.code, 0);
    EXPECT_EQ(groff.out, "");
}

TEST(Manual, PageHoldsEveryCommandAndOption)
{
    const Outcome man = run_lumel({"man"});
    EXPECT_EQ(man.code, 0) << man.err;
    for (const std::string command : kCommands) {
        EXPECT_NE(man.out.find("\n.B lumel " + command), std::string::npos) << command;
        for (std::string option : options_in_help(command)) {
            std::string escaped;
            for (const char letter : option)
                escaped += letter == '-' ? std::string("\\-") : std::string(1, letter);
            EXPECT_NE(man.out.find(escaped), std::string::npos) << option;
        }
    }
}

/// Where a line of --help begins, or npos.
std::size_t place_in(const std::string& help, const std::string& line)
{
    return help.find("\n" + line);
}

TEST(Manual, HelpBeginsWithWhatIsUsedEveryDay)
{
    const std::string program = run_lumel({"--help"}).out;
    const std::size_t more = place_in(program, "More commands:");
    ASSERT_NE(more, std::string::npos) << program;
    for (const char* command : {"bake", "view", "report"})
        EXPECT_LT(place_in(program, std::string("  ") + command + " "), more) << command;
    for (const char* command : {"compare", "reference", "why"}) {
        EXPECT_GT(place_in(program, std::string("  ") + command + " "), more) << command;
        EXPECT_NE(place_in(program, std::string("  ") + command + " "), std::string::npos);
    }

    const std::string bake = run_lumel({"help", "bake"}).out;
    const std::size_t everyday = place_in(bake, "Everyday options:");
    const std::size_t device = place_in(bake, "Device and messages:");
    EXPECT_LT(everyday, place_in(bake, "  --quality "));
    EXPECT_LT(place_in(bake, "  --quality "), place_in(bake, "  --size "));
    EXPECT_LT(place_in(bake, "  --size "), device);
    EXPECT_LT(device, place_in(bake, "  --solver "));
    EXPECT_EQ(bake.find("\n  --size "), bake.rfind("\n  --size ")) << "listed twice";
}

TEST(Completion, ScriptsAreWellFormed)
{
    const Workplace place;
    for (const std::string shell : {"bash", "zsh"}) {
        const Outcome script = run_lumel({"completion", shell});
        EXPECT_EQ(script.code, 0) << script.err;
        if (!is_installed(shell))
            continue;
        const Outcome check = run_shell(shell + " -n '" + place.file(shell, script.out) + "'");
        EXPECT_EQ(check.code, 0) << check.out;
        EXPECT_EQ(check.out, "");
    }
}

TEST(Completion, BashOffersWhatHelpLists)
{
    const Workplace place;
    const std::string script = place.file("lumel.bash", run_lumel({"completion", "bash"}).out);
    Words commands;
    for (const char* command : kCommands)
        commands.insert(command);
    EXPECT_EQ(completed_by_bash(script, "lumel help \"\""), commands);
    for (const std::string command : kCommands)
        EXPECT_EQ(completed_by_bash(script, "lumel " + command + " -"), options_in_help(command))
            << command;
}

TEST(Completion, BashOffersValues)
{
    const Workplace place;
    const std::string script = place.file("lumel.bash", run_lumel({"completion", "bash"}).out);
    EXPECT_EQ(completed_by_bash(script, "lumel ba"), Words{"bake"});
    EXPECT_EQ(completed_by_bash(script, "lumel --ver"), Words{"--version"});
    EXPECT_EQ(completed_by_bash(script, "lumel bake --sampling \"\""), (Words{"area", "centre"}));
    EXPECT_EQ(completed_by_bash(script, "lumel bake --solver st"), Words{"stochastic"});
    EXPECT_EQ(completed_by_bash(script, "lumel completion z"), Words{"zsh"});
    // Names of files are the shell's to find; of numbers it knows nothing.
    EXPECT_EQ(completed_by_bash(script, "lumel bake room"), Words{"<-o default>"});
    EXPECT_EQ(completed_by_bash(script, "lumel bake --sky d"), Words{"<-o default>"});
    EXPECT_EQ(completed_by_bash(script, "lumel bake --sky ov"),
              (Words{"<-o default>", "overcast"}));
    EXPECT_EQ(completed_by_bash(script, "lumel bake --dump d"), Words{"<-o dirnames>"});
    EXPECT_EQ(completed_by_bash(script, "lumel bake --size \"\""), Words{});
}

TEST(Completion, ZshDescribesWhatHelpLists)
{
    const std::string script = run_lumel({"completion", "zsh"}).out;
    for (const std::string command : kCommands) {
        const std::size_t begin = script.find("\n    " + command + ")");
        ASSERT_NE(begin, std::string::npos) << command;
        const std::string part = script.substr(begin, script.find(";;", begin) - begin);
        for (const std::string& option : options_in_help(command))
            EXPECT_NE(part.find(option), std::string::npos) << option << " of " << command;
    }
}

}  // namespace
}  // namespace lumel::test
