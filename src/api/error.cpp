#include "lumel/lumel.h"

namespace lumel::v0 {

// Hosts and people read the header, so the version is plain text there.
static_assert(LUMEL_VERSION == LUMEL_PROJECT_VERSION, "the header is of another version");

int version() noexcept
{
    return LUMEL_VERSION;
}

Error::Error(ErrorKind kind, const std::string& sentence)
    : std::runtime_error(sentence),
      kind_(kind)
{
}

Error::~Error() = default;

}  // namespace lumel::v0
