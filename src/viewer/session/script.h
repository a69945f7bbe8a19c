#pragma once
// Scripts of viewer commands, one per line.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/options.h"

namespace lumel {

enum class Verb {
    camera,
    eye,
    look,
    walk,
    gaze,
    orbit,
    pick,
    move,
    turn,
    remove,
    lamp,
    dim,
    paint,
    sky,
    turn_sky,
    sun,
    time,
    solve,
    light,
    probes,
    exposure,
    stops,
    mode,
    scale,
    frames,
    wait,
    picture,
    state,
    window,
    save,
    quit,
};

/// Arguments of a command: first a word, if it takes one, then numbers as one word.
enum class ArgumentKind {
    none,
    name,             ///< name of an object in the scene
    name_or_numbers,  ///< either
    automatic,        ///< "auto", or the numbers
    off,              ///< "off", or the numbers
    mode,             ///< "lit", "irradiance", "lumels", "links" or "error"
    light,            ///< "links" or "solved"
    method,           ///< a method, and then options with their values
    png,              ///< file name
    json,
    folder,  ///< folder name
};

/// Numbers that a command takes.
struct NumberForm {
    std::size_t least = 0, most = 0;  ///< 1 and 3: either
    double low = 0.0, high = 0.0;     ///< range
    bool whole = false;               ///< integers
};

struct CommandForm {
    Verb verb;
    const char *word, *arguments, *meaning;
    NumberForm numbers = {};
    ArgumentKind takes = ArgumentKind::none;
};

/// All commands, in the order of the help.
std::span<const CommandForm> command_forms();

struct ScriptCommand {
    const CommandForm* form;
    int line;                     ///< from 1; 0: --solver
    std::string text;             ///< the word
    std::vector<double> numbers;  ///< empty if replaced by the word
    SolverOptions solver = {};    ///< for ArgumentKind::method
};

/// place: file name for messages. Throws Error{input} with "place:line" for unknown commands, and
/// for files written twice.
std::vector<ScriptCommand> read_script(std::string_view text, const std::string& place);

/// The command that solves by a method, as line 0 of a script.
ScriptCommand solve_command(const SolverOptions& solver);

/// A line of the script for messages; line 0 is --solver.
std::string line_of(const std::string& place, int line);

}  // namespace lumel
