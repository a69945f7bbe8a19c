#pragma once
// A list of what a hand would do to a scene, a command a line.

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

/// What a command takes: first a word, if it takes one, then numbers as one word.
enum class ArgumentKind {
    none,
    name,             ///< of something in the scene
    name_or_numbers,  ///< one of the two
    automatic,        ///< "auto", or the numbers
    off,              ///< "off", or the numbers
    mode,             ///< "lit", "irradiance", "lumels", "links" or "error"
    light,            ///< "links" or "solved"
    method,           ///< a method, and then options with their values
    png,              ///< name of a file
    json,
    folder,  ///< its name
};

struct CommandForm {
    Verb verb;
    const char *word, *arguments, *meaning;
    ArgumentKind takes = ArgumentKind::none;
    std::size_t least = 0, most = 0;  ///< numbers; 1 and 3: one or the other
    double low = 0.0, high = 0.0;     ///< of numbers
    bool whole = false;               ///< numbers have no decimals
};

/// All commands, in the order in which help lists them.
std::span<const CommandForm> command_forms();

struct ScriptCommand {
    const CommandForm* form;
    int line;                     ///< from 1; 0: of --solver
    std::string text;             ///< the word
    std::vector<double> numbers;  ///< empty where the word stands for them
    SolverOptions solver = {};    ///< of ArgumentKind::method
};

/// `place`: the file's name, for messages. Throws Error{input} with "place:line" for what is no
/// command, or writes a file twice.
std::vector<ScriptCommand> read_script(std::string_view text, const std::string& place);

/// The command that solves by a method, as the line 0 of a script.
ScriptCommand solve_command(const SolverOptions& solver);

/// A line of the script, as messages name it; line 0 is --solver.
std::string place_of(const std::string& place, int line);

}  // namespace lumel
