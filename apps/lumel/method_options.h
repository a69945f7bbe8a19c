#pragma once
// The options of methods on the command line, as the table of methods describes them.

#include <string>
#include <string_view>
#include <vector>

#include "command.h"
#include "methods/methods.h"

namespace lumel {

/// The title that --help and docs/options.md put above these options.
inline constexpr const char* kMethodGroup = "Method";

/// An option that a command does not leave to a method, or to any.
struct OmittedOption {
    std::string_view option;
    std::string_view method = {};
};

/// --solver, and the options of all methods; or of those that `ids` names, but for what is omitted.
void add_methods(Command& command, GivenMethod& given,
                 const std::vector<std::string_view>& ids = {},
                 const std::vector<OmittedOption>& omitted = {});

/// Throws Error{input} if a value was given for an option that is omitted.
void refuse_omitted(const GivenMethod& given, const std::vector<OmittedOption>& omitted);

/// All methods: "links|stochastic|…"
std::string names_of_methods();

/// The options of the one method that `given` names.
void add_one_method(Command& command, GivenMethod& given);

}  // namespace lumel
