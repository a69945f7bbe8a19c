#include "method_options.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/core/error.h"

namespace lumel {
namespace {

/// `standard`: its default. `note`: what else --help says.
void add(CLI::App& app, GivenMethod& given, const OptionInfo& option, const std::string& standard,
         const std::string& note = {})
{
    const std::string name = option.name;
    app.add_option_function<std::string>(
           "--" + name, [&given, name](const std::string& value) { given.values[name] = value; },
           std::string(option.help) + note)
        ->type_name(option.type)
        ->default_str(standard);
}

std::string default_of(const MethodInfo& method, const std::string& option)
{
    return method.option(option)->get(method.defaults());
}

bool among(const std::vector<std::string_view>& names, std::string_view name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_omitted(const std::vector<OmittedOption>& omitted, std::string_view option,
                std::string_view method)
{
    return std::any_of(omitted.begin(), omitted.end(), [&](const OmittedOption& one) {
        return one.option == option && (one.method.empty() || one.method == method);
    });
}

/// "links|stochastic|…"
std::string listed(const std::vector<std::string_view>& ids)
{
    std::string list;
    for (const std::string_view id : ids)
        list += (list.empty() ? "" : "|") + std::string(id);
    return list;
}

std::vector<std::string_view> all_methods()
{
    std::vector<std::string_view> ids;
    for (const MethodInfo& method : methods())
        ids.push_back(method.id);
    return ids;
}

/// The default of the first reader, and those of others that differ.
std::string defaults_of(const SharedOption& shared)
{
    const std::string first = default_of(*shared.readers.front(), shared.info->name);
    std::string list = first;
    for (const MethodInfo* reader : shared.readers) {
        const std::string own = default_of(*reader, shared.info->name);
        if (own != first)
            list += fmt::format(", {} with {}", own, reader->id);
    }
    return list;
}

}  // namespace

void add_methods(CLI::App& app, GivenMethod& given, const std::vector<std::string_view>& some,
                 const std::vector<OmittedOption>& omitted)
{
    const std::vector<std::string_view> ids = some.empty() ? all_methods() : some;
    app.option_defaults()->group(kMethodGroup);
    CLI::Option* solver = app.add_option("--solver", given.id, "Method, see lumel methods")
                              ->type_name(listed(ids))
                              ->capture_default_str();
    if (!some.empty())
        solver->check(CLI::IsMember(std::vector<std::string>(ids.begin(), ids.end())));
    for (SharedOption shared : options_of_methods()) {
        std::erase_if(shared.readers, [&](const MethodInfo* reader) {
            return !among(ids, reader->id) || is_omitted(omitted, shared.info->name, reader->id);
        });
        if (shared.readers.empty())
            continue;
        std::string note;
        if (shared.readers.size() < ids.size()) {
            for (const MethodInfo* reader : shared.readers)
                note += (note.empty() ? " (only " : ", ") + std::string(reader->id);
            note += ")";
        }
        add(app, given, *shared.info, defaults_of(shared), note);
    }
}

void refuse_omitted(const GivenMethod& given, const std::vector<OmittedOption>& omitted)
{
    for (const auto& [option, value] : given.values)
        if (is_omitted(omitted, option, given.id))
            throw Error(ErrorKind::input, "--" + option,
                        "is not read by --solver " + given.id + " here");
}

void add_one_method(CLI::App& app, GivenMethod& given)
{
    app.option_defaults()->group(kMethodGroup);
    const MethodInfo& method = method_of(given.id);
    for (const OptionInfo& option : method.options)
        add(app, given, option, default_of(method, option.name));
}

std::string names_of_methods()
{
    return listed(all_methods());
}

}  // namespace lumel
