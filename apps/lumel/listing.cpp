#include "listing.h"

#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

namespace lumel {
namespace {

std::string upper_case(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return char(std::toupper(letter)); });
    return text;
}

/// Adds an option to its section, or its command to the row that it has already.
void add_row(std::vector<OptionSection>& sections, const CLI::Option& option,
             const std::string& command)
{
    const std::string& title = option.get_group();
    auto section = std::find_if(sections.begin(), sections.end(),
                                [&](const OptionSection& known) { return known.title == title; });
    if (section == sections.end())
        section = sections.insert(sections.end(), OptionSection{title, {}});
    const OptionRow row{
        spelling(option), {command}, option.get_default_str(), option.get_description()};
    for (OptionRow& known : section->rows)
        if (known.name == row.name && known.value == row.value && known.meaning == row.meaning) {
            known.commands.push_back(command);
            return;
        }
    section->rows.push_back(row);
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& program)
{
    return program.get_subcommands(
        [](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional)
{
    return app.get_options([positional](const CLI::Option* option) {
        return option->get_positional() == positional && !option->get_group().empty();
    });
}

std::vector<std::string> names_of(const CLI::Option& option)
{
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

std::string type_of(const CLI::Option& option)
{
    std::string type = option.get_type_name();
    type.resize(std::min(type.find(':'), type.size()));  // CLI11 adds names of validators
    return type;
}

std::string spelling(const CLI::Option& option)
{
    if (option.get_positional())
        return upper_case(option.get_name(true));
    const std::string type = type_of(option);
    return CLI::detail::join(names_of(option), ", ") + (type.empty() ? "" : " " + type);
}

std::string usage(const CLI::App& app, const std::string& path)
{
    std::string line = path;
    if (!commands_of(app).empty())
        return line + " COMMAND ARGUMENTS [OPTIONS]";
    for (const CLI::Option* argument : options_of(app, true)) {
        const std::string name = spelling(*argument);
        line += argument->get_required() ? " " + name : " [" + name + "]";
    }
    return line + " [OPTIONS]";
}

std::vector<OptionSection> sections_of(const CLI::App& program)
{
    std::vector<OptionSection> sections;
    for (const CLI::App* command : commands_of(program))
        for (const CLI::Option* option : options_of(*command, false))
            add_row(sections, *option, command->get_name());
    // What all commands have comes first in each of them, and last on the page.
    std::rotate(sections.begin(), sections.begin() + (sections.empty() ? 0 : 1), sections.end());
    return sections;
}

std::string commands_text(const OptionRow& row, const CLI::App& program)
{
    return row.commands.size() == commands_of(program).size()
               ? "all"
               : CLI::detail::join(row.commands, ", ");
}

}  // namespace lumel
