#include "manual.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
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

std::string meaning_with_default(const CLI::Option& option)
{
    const std::string value = option.get_default_str();
    return option.get_description() + (value.empty() ? "" : " [" + value + "]");
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

std::string table(const OptionSection& section, const CLI::App& program)
{
    std::string text = "\n## " + section.title +
                       "\n\n| option | commands | default | meaning |\n|---|---|---|---|\n";
    for (const OptionRow& row : section.rows)
        text += fmt::format("| `{}` | {} | {} | {} |\n", cell(row.name),
                            commands_text(row, program), cell(row.value), cell(row.meaning));
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
    std::istringstream footer(app.get_footer());
    for (std::string line; std::getline(footer, line);) {
        const std::size_t tab = line.find('\t');
        text += tab == line.npos ? line + "\n" : entry(line.substr(0, tab), line.substr(tab + 1));
    }
    return text;
}

std::string options_page(const CLI::App& program)
{
    const std::vector<const CLI::App*> commands = commands_of(program);
    std::string text =
        "# Commands and options\n\n"
        "<!-- Printed by `lumel options`, from the tables that also print --help. -->\n\n"
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
    for (const OptionSection& section : sections_of(program))
        text += table(section, program);
    return text + table_of_methods();
}

}  // namespace lumel
