#include "api/warnings.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "api/fields.h"
#include "lumel/lumel.h"

namespace lumel::v0 {
namespace {

struct Listener {
    std::mutex mutex;
    WarningFunction function;
};

/// One for the process: calls that have messages share no object.
Listener& listener()
{
    static Listener one;
    return one;
}

}  // namespace

void on_warning(WarningFunction function)
{
    const std::lock_guard lock(listener().mutex);
    listener().function = std::move(function);
}

std::vector<std::string> told(const std::vector<std::string>& messages,
                              const std::vector<std::string>& known)
{
    std::vector<std::string> result = in_fields(messages);
    const std::lock_guard lock(listener().mutex);
    if (listener().function)
        for (const std::string& message : result)
            if (std::ranges::find(known, message) == known.end())
                listener().function(message);
    return result;
}

}  // namespace lumel::v0
