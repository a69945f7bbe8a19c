// The tables of options given to CLI11. No other file of the program includes it.

#include "parser.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/core/error.h"
#include "listing.h"
#include "suggestion.h"

namespace lumel {
namespace {

/// Adds an option without its checks, by the type of its target.
struct Adder {
    CLI::App& app;
    const Option& option;

    CLI::Option* operator()(const HelpFlag&) const { return app.set_help_flag(option.names); }
    CLI::Option* operator()(const VersionFlag&) const
    {
        return app.set_version_flag(option.names, option.names);
    }
    CLI::Option* operator()(bool* flag) const { return app.add_flag(option.names, *flag); }
    CLI::Option* operator()(const std::function<void()>& call) const
    {
        return app.add_flag_callback(option.names, call);
    }
    template <class Value>
    CLI::Option* operator()(Value* value) const
    {
        return app.add_option(option.names, *value);
    }
    CLI::Option* operator()(const std::function<void(double)>& call) const
    {
        return app.add_option_function<double>(option.names, call);
    }
    CLI::Option* operator()(const std::function<void(const std::string&)>& call) const
    {
        if (!option.repeatable)
            return app.add_option_function<std::string>(option.names, call);
        return app.add_option_function<std::vector<std::string>>(
            option.names, [call](const std::vector<std::string>& texts) {
                for (const std::string& text : texts)
                    call(text);
            });
    }
    CLI::Option* operator()(const std::function<void(std::array<double, 2>)>& call) const
    {
        const auto call_with_pair = [call](const std::vector<double>& numbers) {
            call({numbers[0], numbers[1]});
        };
        return app.add_option_function<std::vector<double>>(option.names, call_with_pair)
            ->delimiter(',')
            ->expected(2);
    }
};

/// An option, and the parser's own object for it.
struct Known {
    Option* option;
    CLI::Option* parsed;
};

Known add(CLI::App& app, Option& option)
{
    CLI::Option* added = std::visit(Adder{app, option}, option.target);
    if (!option.type.empty())
        added->type_name(option.type);
    if (option.required)
        added->required();
    if (option.check)
        added->check(option.check);
    if (option.repeatable)
        added->allow_extra_args(false);  // one value at a time, so that an argument may follow
    return {&option, added};
}

std::vector<Known> add_all(CLI::App& app, Command& command)
{
    app.set_help_flag();
    std::vector<Known> all;
    for (Option& option : command.options)
        all.push_back(add(app, option));
    for (const auto& [option, parsed] : all) {
        if (!option->needs.empty())
            parsed->needs(app.get_option(option->needs));
        if (!option->excludes.empty())
            parsed->excludes(app.get_option(option->excludes));
    }
    return all;
}

/// The command that was named on the command line, else the program.
const Command& named_command(const Command& program, const CLI::App& app)
{
    const auto given = app.get_subcommands();
    for (const Command& command : program.commands)
        if (!given.empty() && command.name == given.front()->get_name())
            return command;
    return program;
}

/// The sentence for a command line that the parser does not accept.
std::string complaint(const Command& program, const CLI::App& app, const CLI::ParseError& error)
{
    const Command& command = named_command(program, app);
    const bool none_named = &command == &program;
    const std::vector<std::string> extras = app.remaining(true);
    for (const std::string& word : extras)
        if (word.starts_with('-'))
            return unknown_option(program, command, word);
    if (!extras.empty() && none_named)
        return unknown_command(program, extras.front());
    if (extras.empty() && none_named && error.get_name() == "RequiredError")
        return "no command given; see lumel --help";
    const std::string advice = "; see " + path_of(program, command) + " --help";
    return extras.empty() ? error.what() + advice
                          : fmt::format("unexpected argument {}{}", extras.front(), advice);
}

}  // namespace

Parsed parse(Command& program, int count, char** values)
{
    CLI::App app("", program.name);
    app.require_subcommand(1);
    std::vector<Known> known = add_all(app, program);
    for (Command& command : program.commands) {
        const std::vector<Known> own = add_all(*app.add_subcommand(command.name), command);
        known.insert(known.end(), own.begin(), own.end());
    }
    Parsed result;
    try {
        app.parse(count, values);
    } catch (const CLI::CallForHelp&) {
        result.wish = Parsed::Wish::help;
    } catch (const CLI::CallForVersion&) {
        result.wish = Parsed::Wish::version;
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorKind::input, "", complaint(program, app, error));
    }
    for (const auto& [option, parsed] : known)
        option->count = parsed->count();
    result.command = &named_command(program, app);
    return result;
}

}  // namespace lumel
