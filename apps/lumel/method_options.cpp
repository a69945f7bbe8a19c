#include "method_options.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/error.h"
#include "option_values.h"

namespace lumel {
namespace {

Option option_of(GivenMethod& given, const OptionInfo& info, const std::string& default_value)
{
    const std::string name = info.name;
    return {"--" + name, info.type(), info.help,
            [&given, name](const std::string& value) { given.values[name] = value; },
            default_value};
}

std::string default_of(const MethodInfo& method, const std::string& option)
{
    return get_option(method.defaults(), *method.option(option));
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

/// Accepts the names of some methods.
Check one_of(const std::vector<std::string_view>& ids)
{
    return [ids](const std::string& id) -> std::string {
        return among(ids, id) ? "" : fmt::format("{} not in {{{}}}", id, fmt::join(ids, ","));
    };
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

void add_methods(Command& command, GivenMethod& given, const std::vector<std::string_view>& some,
                 const std::vector<OmittedOption>& omitted)
{
    const std::vector<std::string_view> ids = some.empty() ? all_methods() : some;
    Option solver{"--solver", listed(ids), "Method, see lumel methods", &given.id, given.id};
    if (!some.empty())
        solver.check = one_of(ids);
    command.add(kMethodGroup, {solver});
    for (SharedOption shared : options_of_methods()) {
        std::erase_if(shared.readers, [&](const MethodInfo* reader) {
            return !among(ids, reader->id) || is_omitted(omitted, shared.info->name, reader->id);
        });
        if (shared.readers.empty())
            continue;
        Option option = option_of(given, *shared.info, defaults_of(shared));
        if (shared.readers.size() < ids.size()) {
            std::vector<std::string> readers;
            for (const MethodInfo* reader : shared.readers)
                readers.push_back(reader->id);
            option.help += " (only " + joined(readers, ", ") + ")";
        }
        command.add(kMethodGroup, {option});
    }
}

void refuse_omitted(const GivenMethod& given, const std::vector<OmittedOption>& omitted)
{
    for (const auto& [option, value] : given.values)
        if (is_omitted(omitted, option, given.id))
            throw Error(ErrorKind::input, "--" + option,
                        "is not read by --solver " + given.id + " here");
}

void add_one_method(Command& command, GivenMethod& given)
{
    const MethodInfo& method = method_of(given.id);
    for (const OptionInfo& option : method.options)
        command.add(kMethodGroup, {option_of(given, option, default_of(method, option.name))});
}

std::string names_of_methods()
{
    return listed(all_methods());
}

}  // namespace lumel
