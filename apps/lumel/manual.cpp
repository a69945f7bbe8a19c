#include "manual.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace lumel {
namespace {

constexpr std::size_t kColumns = 100;       // of --help [characters]
constexpr std::size_t kMeaningColumn = 28;  // where the meaning of an option begins
constexpr std::string_view kNothing = "–";  // in an empty cell of a table

std::string upper_case(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return char(std::toupper(letter)); });
    return text;
}

/// "-q, --quiet" or "--size N"; for arguments without a dash their name in capitals.
std::string spelling(const CLI::Option& option)
{
    if (option.get_positional())
        return upper_case(option.get_name(true));
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    std::string type = option.get_type_name();
    type.resize(std::min(type.find(':'), type.size()));  // CLI11 adds names of validators
    return CLI::detail::join(names, ", ") + (type.empty() ? "" : " " + type);
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional)
{
    return app.get_options([positional](const CLI::Option* option) {
        return option->get_positional() == positional && !option->get_group().empty();
    });
}

std::vector<const CLI::App*> commands_of(const CLI::App& program)
{
    return program.get_subcommands(
        [](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string usage(const CLI::App& app, const std::string& path)
{
    std::string line = path;
    if (!commands_of(app).empty())
        return line + " COMMAND ARGUMENTS [OPTIONS]";
    for (const CLI::Option* argument : options_of(app, true))
        line += " " + spelling(*argument);
    return line + " [OPTIONS]";
}

/// Two columns, the second one broken at words.
std::string entry(const std::string& name, const std::string& meaning)
{
    std::string line = "  " + name;
    std::string text;
    const auto start_column = [&] {
        if (line.size() >= kMeaningColumn) {
            text += line + "\n";
            line.clear();
        }
        line.resize(kMeaningColumn, ' ');
    };
    start_column();
    std::istringstream words(meaning);
    bool first = true;
    for (std::string word; words >> word; first = false) {
        if (!first && line.size() + 1 + word.size() > kColumns) {
            text += line + "\n";
            line.assign(kMeaningColumn, ' ');
            first = true;
        }
        line += first ? word : " " + word;
    }
    return text + line + "\n";
}

std::string meaning_with_default(const CLI::Option& option)
{
    const std::string value = option.get_default_str();
    return option.get_description() + (value.empty() ? "" : " [" + value + "]");
}

/// An option of one or more commands.
struct Row {
    std::string name;
    std::vector<std::string> commands;
    std::string value;  ///< its default
    std::string meaning;
};

struct Section {
    std::string title;
    std::vector<Row> rows;
};

/// Adds an option to its section; the same option of several commands makes one row.
void add_row(std::vector<Section>& sections, const std::string& title, const CLI::Option& option,
             const std::string& command)
{
    auto section = std::find_if(sections.begin(), sections.end(),
                                [&](const Section& known) { return known.title == title; });
    if (section == sections.end())
        section = sections.insert(sections.end(), Section{title, {}});
    const Row row{spelling(option), {command}, option.get_default_str(), option.get_description()};
    for (Row& known : section->rows)
        if (known.name == row.name && known.value == row.value && known.meaning == row.meaning) {
            known.commands.push_back(command);
            return;
        }
    section->rows.push_back(row);
}

/// Text as a cell of a Markdown table.
std::string cell(std::string_view text)
{
    if (text.empty())
        return std::string(kNothing);
    std::string escaped;
    for (const char letter : text)
        escaped += letter == '|' ? std::string("\\|") : std::string(1, letter);
    return escaped;
}

std::string table(const Section& section, std::size_t command_count)
{
    std::string text = "\n## " + section.title +
                       "\n\n| option | commands | default | meaning |\n|---|---|---|---|\n";
    for (const Row& row : section.rows)
        text += fmt::format(
            "| `{}` | {} | {} | {} |\n", cell(row.name),
            row.commands.size() == command_count ? "all" : CLI::detail::join(row.commands, ", "),
            cell(row.value), cell(row.meaning));
    return text;
}

}  // namespace

std::string help_text(const CLI::App& app, const std::string& path)
{
    std::string text = app.get_description() + "\n\nUsage: " + usage(app, path) + "\n";
    const auto list = [&](const std::string& title, const std::vector<const CLI::Option*>& group) {
        if (group.empty())
            return;
        text += "\n" + title + ":\n";
        for (const CLI::Option* option : group)
            text += entry(spelling(*option), meaning_with_default(*option));
    };
    list("Arguments", options_of(app, true));
    const std::vector<const CLI::App*> commands = commands_of(app);
    if (!commands.empty())
        text += "\nCommands:\n";
    for (const CLI::App* command : commands)
        text += entry(command->get_name(), command->get_description());
    const std::vector<const CLI::Option*> options = options_of(app, false);
    for (const std::string& title : app.get_groups()) {
        std::vector<const CLI::Option*> group;
        std::copy_if(options.begin(), options.end(), std::back_inserter(group),
                     [&](const CLI::Option* option) { return option->get_group() == title; });
        list(title, group);
    }
    return text;
}

std::string options_page(const CLI::App& program)
{
    const std::vector<const CLI::App*> commands = commands_of(program);
    std::vector<Section> sections;
    std::string text =
        "# Commands and options\n\n"
        "<!-- Printed by `lumel options`, from the table that also prints --help. -->\n\n"
        "| command | what it does |\n|---|---|\n";
    for (const CLI::App* command : commands)
        text += fmt::format("| `{}` | {} |\n",
                            cell(usage(*command, program.get_name() + " " + command->get_name())),
                            cell(command->get_description()));
    text += "\n## Arguments\n\n| command | argument | meaning |\n|---|---|---|\n";
    for (const CLI::App* command : commands)
        for (const CLI::Option* argument : options_of(*command, true))
            text += fmt::format("| {} | `{}` | {} |\n", command->get_name(), spelling(*argument),
                                cell(argument->get_description()));
    for (const CLI::App* command : commands)
        for (const CLI::Option* option : options_of(*command, false))
            add_row(sections, option->get_group(), *option, command->get_name());
    // What all commands have comes first in each of them, and last on the page.
    std::rotate(sections.begin(), sections.begin() + (sections.empty() ? 0 : 1), sections.end());
    for (const Section& section : sections)
        text += table(section, commands.size());
    return text;
}

}  // namespace lumel
