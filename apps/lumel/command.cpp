#include "command.h"

#include <algorithm>
#include <sstream>

namespace lumel {

void Command::add(const std::string& group, std::initializer_list<Option> added)
{
    for (Option option : added) {
        option.group = group;
        options.push_back(std::move(option));
    }
}

bool Command::given(const std::string& option_name) const
{
    return std::any_of(options.begin(), options.end(), [&](const Option& option) {
        const std::vector<std::string> names = names_of(option);
        return option.count > 0 &&
               std::find(names.begin(), names.end(), option_name) != names.end();
    });
}

std::vector<std::string> names_of(const Option& option)
{
    std::vector<std::string> names;
    std::istringstream list(option.names);
    for (std::string name; std::getline(list, name, ',');)
        names.push_back(name);
    return names;
}

}  // namespace lumel
