#include "manual.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "listing.h"
#include "methods/methods.h"

namespace lumel {
namespace {

constexpr std::size_t kColumns = 100;       // of --help [characters]
constexpr std::size_t kMeaningColumn = 28;  // where the meaning of an option begins
constexpr std::string_view kNothing = "–";  // in an empty cell of a table

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

std::string meaning_with_default(const Option& option)
{
    return option.help + (option.default_value.empty() ? "" : " [" + option.default_value + "]");
}

/// Titles of groups of options, in the order in which they first occur.
std::vector<std::string> groups_of(const Command& command)
{
    std::vector<std::string> groups;
    for (const Option* option : options_of(command))
        if (std::find(groups.begin(), groups.end(), option->group) == groups.end())
            groups.push_back(option->group);
    return groups;
}

std::vector<const Option*> everyday_options_of(const Command& command)
{
    std::vector<const Option*> found;
    for (const std::string& name : command.everyday_options)
        for (const Option* option : options_of(command))
            if (const auto names = names_of(*option); std::ranges::find(names, name) != names.end())
                found.push_back(option);
    return found;
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

std::string table(const OptionSection& section, const Command& program)
{
    std::string text = "\n## " + section.title +
                       "\n\n| option | commands | default | meaning |\n|---|---|---|---|\n";
    for (const OptionRow& row : section.rows)
        text +=
            fmt::format("| `{}` | {} | {} | {} |\n", cell(row.name), commands_text(row, program),
                        cell(row.default_value), cell(row.meaning));
    return text;
}

std::string table_of_methods()
{
    std::string text = "\n## Methods\n\n| `--solver` | method | papers | use it for | options |\n"
                       "|---|---|---|---|---|\n";
    for (const MethodInfo& method : methods()) {
        std::string options;
        for (const OptionInfo& option : method.options)
            options += fmt::format("{}`--{}`", options.empty() ? "" : ", ", option.name);
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", method.id, cell(method.title),
                            method.paper, cell(method.advice), options);
    }
    return text;
}

}  // namespace

std::string help_text(const Command& program, const Command& command)
{
    std::string text = command.help + "\n\nUsage: " + usage(program, command) + "\n";
    const auto list = [&](const std::string& title, const std::vector<const Option*>& group) {
        if (group.empty())
            return;
        text += "\n" + title + ":\n";
        for (const Option* option : group)
            text += entry(spelling(*option), meaning_with_default(*option));
    };
    list("Arguments", arguments_of(command));
    for (const bool everyday : {true, false}) {
        std::vector<const Command*> commands = commands_of(command);
        std::erase_if(commands, [&](const Command* one) { return one->everyday != everyday; });
        if (!commands.empty())
            text += everyday ? "\nCommands:\n" : "\nMore commands:\n";
        for (const Command* one : commands)
            text += entry(one->name, one->help);
    }
    const std::vector<const Option*> everyday = everyday_options_of(command);
    list("Everyday options", everyday);
    for (const std::string& title : groups_of(command)) {
        std::vector<const Option*> group = options_of(command);
        std::erase_if(group, [&](const Option* option) {
            return option->group != title || std::ranges::find(everyday, option) != everyday.end();
        });
        list(title, group);
    }
    std::istringstream footer(command.footer);
    for (std::string line; std::getline(footer, line);) {
        const std::size_t tab = line.find('\t');
        text += tab == line.npos ? line + "\n" : entry(line.substr(0, tab), line.substr(tab + 1));
    }
    return text;
}

std::string options_page(const Command& program)
{
    const std::vector<const Command*> commands = commands_of(program);
    std::string text =
        "# Commands and options\n\n"
        "<!-- Printed by `lumel options`, from the tables that also print --help. -->\n\n"
        "| command | what it does |\n|---|---|\n";
    for (const Command* command : commands)
        text += fmt::format("| `{}` | {} |\n", cell(usage(program, *command)), cell(command->help));
    text += "\n## Arguments\n\n| command | argument | meaning |\n|---|---|---|\n";
    for (const Command* command : commands)
        for (const Option* argument : arguments_of(*command))
            text += fmt::format("| {} | `{}` | {} |\n", command->name, spelling(*argument),
                                cell(argument->help));
    for (const OptionSection& section : sections_of(program))
        text += table(section, program);
    return text + table_of_methods();
}

}  // namespace lumel
