#include "completion.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/core.h>

#include "listing.h"
#include "option_values.h"

namespace lumel {
namespace {

/// What may stand as the value of an option.
struct Values {
    bool files = false, folders = false, commands = false;
    std::vector<std::string> words;  ///< that are to be typed as they are
};

/// Types name kinds in capitals and words as they are: "FILE|R,G,B", "area|centre".
Values values_of(const Option& option)
{
    Values values;
    std::istringstream parts(option.type);
    for (std::string part; std::getline(parts, part, '|');) {
        const bool word = std::none_of(part.begin(), part.end(),
                                       [](char letter) { return letter >= 'A' && letter <= 'Z'; });
        values.files = values.files || part == "FILE";
        values.folders = values.folders || part == "FOLDER";
        values.commands = values.commands || part == kCommandType;
        if (word && !part.empty())
            values.words.push_back(part);
    }
    return values;
}

std::vector<std::string> names_of_commands(const Command& program)
{
    std::vector<std::string> names;
    for (const Command* command : commands_of(program))
        names.push_back(command->name);
    return names;
}

std::vector<std::string> names_of_options(const Command& command)
{
    std::vector<std::string> all;
    for (const Option* option : options_of(command))
        for (const std::string& name : names_of(*option))
            all.push_back(name);
    return all;
}

std::string spaced(const std::vector<std::string>& words)
{
    return joined(words, " ");
}

// bash: words come from a list; where none of them fits, files or folders, or nothing that is
// known.

std::string bash_values(const Command& program, const Values& values)
{
    if (values.commands)
        return fmt::format("words='{}'", spaced(names_of_commands(program)));
    const std::string words =
        values.words.empty() ? "" : fmt::format("words='{}'", spaced(values.words));
    if (values.files)
        return "compopt -o default" + (words.empty() ? "" : "; " + words);
    if (!words.empty())
        return words;
    return values.folders ? "compopt -o dirnames" : ":";
}

std::string bash_command(const Command& program, const Command& command)
{
    std::map<std::string, std::vector<std::string>> options;  // by what completes their values
    for (const Option* option : options_of(command))
        for (const std::string& name : names_of(*option))
            if (!option->type.empty())
                options[bash_values(program, values_of(*option))].push_back(name);
    std::string text = fmt::format("    {})\n        case $before in\n", command.name);
    for (const auto& [values, names] : options)
        text += fmt::format("        {}) {} ;;\n", joined(names, "|"), values);
    Values arguments;  // of all places: which of them is meant is not counted
    for (const Option* argument : arguments_of(command)) {
        const Values own = values_of(*argument);
        arguments.files = arguments.files || own.files;
        arguments.folders = arguments.folders || own.folders;
        arguments.commands = arguments.commands || own.commands;
        arguments.words.insert(arguments.words.end(), own.words.begin(), own.words.end());
    }
    return text + fmt::format("        *) if [[ $word == -* ]]; then words='{}'; else {}; fi ;;\n"
                              "        esac ;;\n",
                              spaced(names_of_options(command)), bash_values(program, arguments));
}

std::string bash_script(const Command& program)
{
    const std::string& name = program.name;
    std::vector<std::string> first = names_of_commands(program);
    for (const std::string& option : names_of_options(program))
        first.push_back(option);
    std::string text = fmt::format(
        "# bash completion of {0}, printed by {0} completion bash\n\n_{0}()\n{{\n"
        "    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=\n"
        "    COMPREPLY=()\n"
        "    if ((COMP_CWORD == 1)); then\n"
        "        mapfile -t COMPREPLY < <(compgen -W '{1}' -- \"$word\")\n"
        "        return\n"
        "    fi\n"
        "    case ${{COMP_WORDS[1]}} in\n",
        name, spaced(first));
    for (const Command* command : commands_of(program))
        text += bash_command(program, *command);
    return text + fmt::format("    esac\n"
                              "    [[ -z $words ]] || "
                              "mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
                              "}}\n\ncomplete -F _{0} {0}\n",
                              name);
}

// zsh: specifications of _arguments, each in single quotes.

/// Text inside of a specification.
std::string zsh_text(const std::string& text)
{
    std::string escaped;
    for (const char letter : text) {
        if (letter == '\'')
            escaped += "'\\'";  // and the quote itself
        else if (letter == '[' || letter == ']' || letter == ':' || letter == '\\')
            escaped += '\\';
        escaped += letter;
    }
    return escaped;
}

std::string zsh_values(const Command& program, const Values& values)
{
    if (values.commands)
        return fmt::format("({})", spaced(names_of_commands(program)));
    if (values.files)
        return values.words.empty()
                   ? "_files"
                   : fmt::format("{{compadd -- {}; _files}}", spaced(values.words));
    if (!values.words.empty())
        return fmt::format("({})", spaced(values.words));
    return values.folders ? "_files -/" : " ";
}

std::string zsh_option(const Command& program, const Option& option)
{
    const std::vector<std::string> names = names_of(option);
    std::string spec = fmt::format("[{}]", zsh_text(option.help));
    if (!option.type.empty())
        spec +=
            fmt::format(":{}:{}", zsh_text(option.type), zsh_values(program, values_of(option)));
    if (names.size() == 1)
        return fmt::format("'{}{}{}'", option.repeatable ? "*" : "", names.front(), spec);
    return fmt::format("'({})'{{{}}}'{}'", spaced(names), joined(names, ","), spec);
}

std::string zsh_command(const Command& program, const Command& command)
{
    std::string text = fmt::format("    {})\n        _arguments", command.name);
    for (const Option* option : options_of(command))
        text += " \\\n            " + zsh_option(program, *option);
    int place = 0;
    for (const Option* argument : arguments_of(command))
        text += fmt::format(" \\\n            '{}:{}:{}'", ++place, zsh_text(argument->names),
                            zsh_values(program, values_of(*argument)));
    return text + " ;;\n";
}

std::string zsh_script(const Command& program)
{
    const std::string& name = program.name;
    std::string text = fmt::format("#compdef {0}\n"
                                   "# zsh completion of {0}, printed by {0} completion zsh\n\n"
                                   "_{0}()\n{{\n"
                                   "    local curcontext=$curcontext state line\n"
                                   "    local -a commands\n"
                                   "    typeset -A opt_args\n"
                                   "    commands=(\n",
                                   name);
    for (const Command* command : commands_of(program))
        text += fmt::format("        '{}:{}'\n", command->name, zsh_text(command->help));
    text += "    )\n    _arguments -C";
    for (const Option* option : options_of(program))
        text += " \\\n        " + zsh_option(program, *option);
    text += " \\\n        '1:command:->command' '*::argument:->argument'\n"
            "    case $state in\n"
            "    command) _describe -t commands command commands; return ;;\n"
            "    argument) ;;\n"
            "    *) return ;;\n"
            "    esac\n"
            "    case $words[1] in\n";
    for (const Command* command : commands_of(program))
        text += zsh_command(program, *command);
    // Sourced, it only makes itself known; found by its name, it is run for the first completion.
    return text + fmt::format("    esac\n}}\n\n"
                              "if [[ $funcstack[1] == _{0} ]]; then _{0} \"$@\"; "
                              "else compdef _{0} {0}; fi\n",
                              name);
}

}  // namespace

std::string completion_script(const Command& program, Shell shell)
{
    return shell == Shell::bash ? bash_script(program) : zsh_script(program);
}

}  // namespace lumel
