#include "viewer/session/script.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/number.h"
#include "base/json/json_view.h"
#include "viewer/session/session.h"
#include "viewer/session/solve_order.h"

namespace lumel {
namespace {

constexpr double kFar = 1e6;          ///< maximum coordinate with float precision [m]
constexpr double kTurns = 36000.0;    ///< maximum angle with decimals in a float [degrees]
constexpr double kBright = 1e6;       ///< maximum factor of a lamp
constexpr double kStops = 100.0;      ///< maximum exposure
constexpr double kMaxPixels = 16384;  ///< maximum side of an image
constexpr double kMaxFrames = 1e6, kMaxCameras = 1e6, kMaxSeconds = 1e6;
constexpr double kMinScale = 1e-6, kMaxScale = 1e12;  ///< [lx]

constexpr NumberForm kNoNumbers;
constexpr NumberForm kPoint{3, 3, -kFar, kFar};
constexpr NumberForm kAngle{1, 1, -kTurns, kTurns}, kAngles{1, 2, -kTurns, kTurns};
constexpr NumberForm kFactor{1, 3, 0.0, kBright};  ///< one for all channels, or one each

constexpr auto kForms = std::to_array<CommandForm>({
    {Verb::camera, "camera", "N", "look through camera N of the file, from 0",
     NumberForm{1, 1, 0.0, kMaxCameras, true}},
    {Verb::eye, "eye", "X,Y,Z", "move the eye there [m]", kPoint},
    {Verb::look, "look", "X,Y,Z", "look at a point [m]", kPoint},
    {Verb::walk, "walk", "F[,R[,U]]", "walk forward (horizontally), right and up [m]",
     NumberForm{1, 3, -kFar, kFar}},
    {Verb::gaze, "gaze", "LEFT[,UP]", "turn the view [degrees]", kAngles},
    {Verb::orbit, "orbit", "AROUND[,OVER]",
     "orbit the picked object, or the centre of the image [degrees]", kAngles},
    {Verb::pick, "pick", "X,Y | NAME",
     "pick the object at a pixel of the image, from its top left; or by name",
     NumberForm{2, 2, 0.0, kMaxPixels, true}, ArgumentKind::name_or_numbers},
    {Verb::move, "move", "X,Y,Z", "move the picked object [m]", kPoint},
    {Verb::turn, "turn", "DEGREES",
     "rotate it about its vertical axis, counter-clockwise from above", kAngle},
    {Verb::remove, "delete", "", "delete it from the scene"},
    {Verb::paint, "paint", "R,G,B", "set the base colour of its material, 0 to 1",
     NumberForm{3, 3, 0.0, 1.0}},
    {Verb::dim, "dim", "F | R,G,B",
     "scale the emission of the picked material, relative to the file", kFactor},
    {Verb::lamp, "lamp", "NAME F | NAME R,G,B",
     "scale the lights, or the emission of the material, of that name", kFactor,
     ArgumentKind::name},
    {Verb::sky, "sky", "F | R,G,B", "scale the sky", kFactor},
    {Verb::turn_sky, "turn-sky", "DEGREES", "rotate the given sky by this angle, counter-clockwise",
     kAngle},
    {Verb::sun, "sun", "AZIMUTH,ELEVATION",
     "set the sun [degrees], its azimuth clockwise from north (-z)",
     NumberForm{2, 2, -kTurns, kTurns}},
    {Verb::time, "time", "SECONDS", "set the time of the animation",
     NumberForm{1, 1, 0.0, kMaxSeconds}},
    {Verb::solve, "solve", "METHOD [--OPTION VALUE ...]",
     "light the current scene by another method, and show it; options and limits are those of "
     "lumel bake",
     kNoNumbers, ArgumentKind::method},
    {Verb::light, "light", "links | solved", "show the light of links, or that of the last solve",
     kNoNumbers, ArgumentKind::light},
    {Verb::probes, "probes", "SPACING | off",
     "show light probes as balls, on a grid of this spacing [m]", NumberForm{1, 1, 1e-3, kFar},
     ArgumentKind::off},
    {Verb::exposure, "exposure", "F | auto",
     "factor from cd/m2 to brightness, or fitted to each image", NumberForm{1, 1, 1e-12, 1e12},
     ArgumentKind::automatic},
    {Verb::stops, "ev", "STOPS", "raise the exposure by this number of stops: 1 is twice as bright",
     NumberForm{1, 1, -kStops, kStops}},
    {Verb::mode, "mode", "lit | irradiance | lumels | links | error",
     "show light, irradiance in false colours with a legend, lumels as fields of their charts, "
     "contributors to the picked lumel, or the estimated error",
     kNoNumbers, ArgumentKind::mode},
    {Verb::scale, "scale", "LOW,HIGH | auto", "ends of the legend [lx], or [%] in mode error",
     NumberForm{2, 2, kMinScale, kMaxScale}, ArgumentKind::automatic},
    {Verb::frames, "frames", "N", "update the light for N frames",
     NumberForm{1, 1, 1.0, kMaxFrames, true}},
    {Verb::wait, "wait", "", "update the light until it has converged and is baked"},
    {Verb::picture, "picture", "FILE.png", "write the image", kNoNumbers, ArgumentKind::png},
    {Verb::state, "state", "FILE.json", "write light, camera, picked object and frame times",
     kNoNumbers, ArgumentKind::json},
    {Verb::window, "window", "FILE.png",
     "write the image of the window with its panel; not with --headless", kNoNumbers,
     ArgumentKind::png},
    {Verb::save, "save", "FOLDER", "bake the current scene into this folder", kNoNumbers,
     ArgumentKind::folder},
    {Verb::quit, "quit", "", "end the script and close the window"},
});

/// Splits a line into words; quoted words can contain blanks. # starts a comment.
class Words {
public:
    Words(std::string_view line, const std::string& place) : rest_(line), place_(place) {}

    /// Reads the next word; false at the end.
    bool next(std::string& word)
    {
        const std::size_t first = rest_.find_first_not_of(" \t\r");
        if (first == rest_.npos || rest_[first] == '#')
            return false;
        rest_.remove_prefix(first);
        const bool is_quoted = rest_.front() == '"';
        if (is_quoted)
            rest_.remove_prefix(1);
        const std::size_t last = is_quoted ? rest_.find('"') : rest_.find_first_of(" \t\r");
        if (is_quoted && last == rest_.npos)
            throw Error(ErrorKind::input, place_, "has an unterminated quote");
        word = rest_.substr(0, last);
        rest_.remove_prefix(std::min(last == rest_.npos ? last : last + 1, rest_.size()));
        return true;
    }

private:
    std::string_view rest_;
    const std::string& place_;
};

bool fits(const CommandForm& form, const std::vector<double>& numbers)
{
    const std::size_t count = numbers.size();
    const bool colour_or_factor = form.numbers.high == kBright;  // one number for three equal ones
    return count >= form.numbers.least && count <= form.numbers.most &&
           !(colour_or_factor && count == 2) &&
           std::all_of(numbers.begin(), numbers.end(), [&](double number) {
               return number >= form.numbers.low && number <= form.numbers.high &&
                      !(form.numbers.whole && number != std::floor(number));
           });
}

/// The numbers of "X,Y,Z"; empty if the command does not accept them.
std::vector<double> numbers_of(const CommandForm& form, std::string_view text)
{
    std::vector<double> numbers;
    for (std::size_t comma = 0; comma != text.npos;) {
        comma = text.find(',');
        const auto number = number_of(text.substr(0, comma));
        if (!number)
            return {};
        numbers.push_back(*number);
        text.remove_prefix(comma == text.npos ? text.size() : comma + 1);
    }
    return fits(form, numbers) ? numbers : std::vector<double>();
}

bool is_file_name(std::string_view name, std::string_view extension)
{
    return name.size() > extension.size() && name.ends_with(extension) &&
           name.find('/') == name.npos && name.front() != '.' && name.front() != '-' &&
           std::none_of(name.begin(), name.end(),
                        [](char letter) { return static_cast<unsigned char>(letter) < ' '; });
}

bool is_word_for(const CommandForm& form, const std::string& word)
{
    switch (form.takes) {
    case ArgumentKind::none:
        return false;
    case ArgumentKind::method:
    case ArgumentKind::name:
    case ArgumentKind::name_or_numbers:
        return true;
    case ArgumentKind::light:
        return word == "links" || word == "solved";
    case ArgumentKind::automatic:
        return word == "auto";
    case ArgumentKind::off:
        return word == "off";
    case ArgumentKind::mode:
        return std::find(kViewModes.begin(), kViewModes.end(), word) != kViewModes.end();
    case ArgumentKind::png:
        return is_file_name(word, ".png");
    case ArgumentKind::json:
        return is_file_name(word, ".json");
    case ArgumentKind::folder:
        return is_file_name(word, "");
    }
    return false;
}

/// Parses the arguments of a command. Returns false if they are invalid.
bool take(ScriptCommand& command, const std::vector<std::string>& words)
{
    const CommandForm& form = *command.form;
    std::size_t taken = 0;
    const bool may_be_numbers =
        form.takes == ArgumentKind::none || form.takes == ArgumentKind::automatic ||
        form.takes == ArgumentKind::off || form.takes == ArgumentKind::name_or_numbers;
    if (may_be_numbers && form.numbers.least > 0 && !words.empty()) {
        command.numbers = numbers_of(form, words[0]);
        taken = command.numbers.empty() ? 0 : 1;
    }
    if (taken == 0 && form.takes != ArgumentKind::none && !words.empty() &&
        is_word_for(form, words[0]))
        command.text = words[taken++];
    if (form.takes == ArgumentKind::name && taken == 1 && words.size() > 1) {
        command.numbers = numbers_of(form, words[1]);
        taken += command.numbers.empty() ? 0 : 1;
    }
    const bool complete = form.takes == ArgumentKind::name || form.takes == ArgumentKind::none
                              ? form.numbers.least == 0 || !command.numbers.empty()
                              : taken == 1;
    return complete && taken == words.size();
}

const CommandForm* form_of(const std::string& word)
{
    const auto found = std::find_if(kForms.begin(), kForms.end(),
                                    [&](const CommandForm& form) { return word == form.word; });
    return found == kForms.end() ? nullptr : &*found;
}

ScriptCommand read_command(const std::string& word, Words& rest, int line, const std::string& place)
{
    ScriptCommand command{.form = form_of(word), .line = line};
    if (command.form == nullptr)
        throw Error(ErrorKind::input, place,
                    lumel::quoted(word) + " is not a command; lumel view --help lists them");
    std::vector<std::string> words;
    for (std::string next; rest.next(next);)
        words.push_back(next);
    const bool orders = command.form->takes == ArgumentKind::method && !words.empty();
    if (orders)
        command.solver = solve_order(words, place);
    if (orders || take(command, words))
        return command;
    std::string given;
    for (const std::string& one : words)
        given += (given.empty() ? "" : " ") + one;
    throw Error(ErrorKind::input, place,
                fmt::format("{} takes {}, not {}", word,
                            *command.form->arguments ? command.form->arguments : "nothing",
                            given.empty() ? std::string("nothing") : lumel::quoted(given)));
}

/// Throws if a script writes a file twice.
void check_files(const std::vector<ScriptCommand>& commands, const std::string& place)
{
    std::vector<std::string> files;
    for (const ScriptCommand& command : commands) {
        const ArgumentKind takes = command.form->takes;
        if (takes != ArgumentKind::png && takes != ArgumentKind::json &&
            takes != ArgumentKind::folder)
            continue;
        if (std::find(files.begin(), files.end(), command.text) != files.end())
            throw Error(ErrorKind::input, line_of(place, command.line),
                        lumel::quoted(command.text) + " is written twice");
        files.push_back(command.text);
    }
}

}  // namespace

std::span<const CommandForm> command_forms()
{
    return kForms;
}

ScriptCommand solve_command(const SolverOptions& solver)
{
    return {.form = form_of("solve"), .line = 0, .solver = solver};
}

std::string line_of(const std::string& place, int line)
{
    return line == 0 ? "--solver" : fmt::format("{}:{}", place, line);
}

std::vector<ScriptCommand> read_script(std::string_view text, const std::string& place)
{
    std::vector<ScriptCommand> commands;
    int line = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string here = line_of(place, ++line);
        Words words(text.substr(0, end), here);
        if (std::string word; words.next(word))
            commands.push_back(read_command(word, words, line, here));
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
    }
    check_files(commands, place);
    return commands;
}

}  // namespace lumel
