#include "listing.h"

#include <algorithm>
#include <cctype>

#include "option_values.h"

namespace lumel {
namespace {

std::string upper_case(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return char(std::toupper(letter)); });
    return text;
}

std::vector<const Option*> listed(const Command& command, bool arguments)
{
    std::vector<const Option*> found;
    for (const Option& option : command.options)
        if (option.is_argument() == arguments)
            found.push_back(&option);
    return found;
}

/// Adds an option to its section, or its command to the row that it has already.
void add_row(std::vector<OptionSection>& sections, const Option& option, const std::string& command)
{
    auto section = std::find_if(sections.begin(), sections.end(), [&](const OptionSection& known) {
        return known.title == option.group;
    });
    if (section == sections.end())
        section = sections.insert(sections.end(), OptionSection{option.group, {}});
    const OptionRow row{spelling(option), {command}, option.default_value, option.help};
    for (OptionRow& known : section->rows)
        if (known.name == row.name && known.default_value == row.default_value &&
            known.meaning == row.meaning) {
            known.commands.push_back(command);
            return;
        }
    section->rows.push_back(row);
}

}  // namespace

std::vector<const Command*> commands_of(const Command& program)
{
    std::vector<const Command*> found;
    for (const Command& command : program.commands)
        if (command.listed)
            found.push_back(&command);
    return found;
}

std::vector<const Option*> arguments_of(const Command& command)
{
    return listed(command, true);
}

std::vector<const Option*> options_of(const Command& command)
{
    return listed(command, false);
}

std::string path_of(const Command& program, const Command& command)
{
    return &command == &program ? program.name : program.name + " " + command.name;
}

std::string spelling(const Option& option)
{
    if (option.is_argument())
        return upper_case(option.names);
    return joined(names_of(option), ", ") + (option.type.empty() ? "" : " " + option.type);
}

std::string usage(const Command& program, const Command& command)
{
    std::string line = path_of(program, command);
    if (!command.commands.empty())
        return line + " COMMAND ARGUMENTS [OPTIONS]";
    for (const Option* argument : arguments_of(command)) {
        const std::string name = spelling(*argument);
        line += argument->required ? " " + name : " [" + name + "]";
    }
    return line + " [OPTIONS]";
}

std::vector<OptionSection> sections_of(const Command& program)
{
    std::vector<OptionSection> sections;
    for (const Command* command : commands_of(program))
        for (const Option* option : options_of(*command))
            add_row(sections, *option, command->name);
    // Options of all commands come first in each command, and last on the page.
    std::rotate(sections.begin(), sections.begin() + (sections.empty() ? 0 : 1), sections.end());
    return sections;
}

std::string commands_text(const OptionRow& row, const Command& program)
{
    return row.commands.size() == commands_of(program).size() ? "all" : joined(row.commands, ", ");
}

}  // namespace lumel
