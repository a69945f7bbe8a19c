#include "method_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace lumel {
namespace {

void add(CLI::App& app, GivenMethod& given, const OptionInfo& option, const std::string& note)
{
    const std::string name = option.name;
    app.add_option_function<std::string>(
           "--" + name, [&given, name](const std::string& value) { given.values[name] = value; },
           fmt::format("{} ({})", option.help, note))
        ->type_name(option.type);
}

std::string default_of(const MethodInfo& method, const OptionInfo& option)
{
    return "default: " + option.get(method.defaults());
}

}  // namespace

void add_methods(CLI::App& app, GivenMethod& given)
{
    app.add_option("--solver", given.id, "Method; lumel methods lists them")
        ->type_name("NAME")
        ->capture_default_str();
    for (const SharedOption& shared : options_of_methods()) {
        const MethodInfo& first = *shared.readers.front();
        std::string note = default_of(first, *shared.info);
        if (shared.readers.size() < methods().size()) {
            note += "; for";
            for (const MethodInfo* reader : shared.readers)
                note += fmt::format("{} {}", reader == &first ? "" : ",", reader->id);
        }
        add(app, given, *shared.info, note);
    }
}

void add_one_method(CLI::App& app, GivenMethod& given)
{
    const MethodInfo& method = method_of(given.id);
    for (const OptionInfo& option : method.options)
        add(app, given, option, default_of(method, option));
}

}  // namespace lumel
