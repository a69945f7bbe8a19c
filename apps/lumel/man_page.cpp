#include "man_page.h"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>

#include "commands.h"
#include "listing.h"
#include "methods/methods.h"

namespace lumel {
namespace {

/// Text that the formatter takes as it stands.
std::string plain(const std::string& text)
{
    std::string escaped;
    for (const char letter : text) {
        if (letter == '\\')
            escaped += "\\e";
        else if (letter == '-')
            escaped += "\\-";  // a minus, which can be copied to a command line, and no hyphen
        else
            escaped += letter;
    }
    // At the start of a line these would begin a request.
    return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string heading(std::string title)
{
    std::transform(title.begin(), title.end(), title.begin(),
                   [](unsigned char letter) { return char(std::toupper(letter)); });
    return fmt::format(".SH \"{}\"\n", plain(title));
}

/// A term, and what it means below it.
std::string item(const std::string& term, const std::string& meaning)
{
    return fmt::format(".TP\n.B {}\n{}\n", plain(term), plain(meaning));
}

/// A sentence of the table, with its full stop.
std::string sentence(const std::string& text)
{
    return text.ends_with('.') ? text : text + ".";
}

std::string commands_section(const Command& program)
{
    std::string text = heading("Commands");
    for (const Command* command : commands_of(program)) {
        text += item(usage(program, *command), sentence(command->help));
        for (const Option* argument : arguments_of(*command))
            text += fmt::format(".RS\n.TP\n.I {}\n{}\n.RE\n", plain(spelling(*argument)),
                                plain(sentence(argument->help)));
    }
    return text;
}

std::string option_section(const OptionSection& section, const Command& program)
{
    std::string text = fmt::format(".SS \"{}\"\n", plain(section.title));
    for (const OptionRow& row : section.rows) {
        text += item(row.name, sentence(row.meaning));
        if (!row.default_value.empty())
            text += fmt::format("Default: {}.\n", plain(row.default_value));
        text += fmt::format("Commands: {}.\n", plain(commands_text(row, program)));
    }
    return text;
}

std::string methods_section()
{
    std::string text = heading("Methods");
    for (const MethodInfo& method : methods())
        text += item(method.id, fmt::format("{} {}. Use it for: {}.", method.title, method.paper,
                                            method.advice));
    return text;
}

std::string exit_section()
{
    return heading("Exit status") + item(std::to_string(kExitDone), "Done.") +
           item(std::to_string(kExitInput),
                "The input or an option cannot be used; one sentence on standard error says what "
                "and where. Nothing is written.") +
           item(std::to_string(kExitDevice),
                "There is no usable device, memory is short, or the device was lost.") +
           item(std::to_string(kExitOutput), "A result cannot be written.") +
           item("128 + N", "Stopped by signal N, 130 by Ctrl-C; what was solved so far is written "
                           "if there is any light yet.");
}

std::string environment_section()
{
    return heading("Environment") +
           item("NO_COLOR", "If it is set and not empty, messages have no colour.") +
           item("LUMEL_VALIDATION",
                "If it is 1, the Khronos validation layer watches; a message of it is an error.");
}

}  // namespace

std::string man_page(const Command& program)
{
    const std::string& name = program.name;
    // No date: the same program prints the same page.
    std::string text =
        fmt::format(".TH LUMEL 1 \"\" \"{} {}\" \"User Commands\"\n", name, plain(LUMEL_VERSION)) +
        heading("Name") + plain(name + " - bakes the light of a glTF scene into lightmaps") + "\n" +
        heading("Synopsis") + fmt::format(".B {}\n", plain(usage(program, program))) +
        heading("Description") +
        plain("Lumel solves the radiosity equation over the texels of a lightmap. "
              "It reads a .gltf or .glb file and writes the lightmap, the lit scene "
              "and a report into a folder.") +
        "\n" + commands_section(program) + heading("Options");
    for (const OptionSection& section : sections_of(program))
        text += option_section(section, program);
    return text + methods_section() + exit_section() + environment_section();
}

}  // namespace lumel
