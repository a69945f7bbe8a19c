#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/core/error.h"
#include "readers.h"

namespace lumel::fuzz {

void require(bool holds, const char* what)
{
    if (holds)
        return;
    std::fprintf(stderr, "not true: %s\n", what);
    std::abort();
}

void check(void (*read)(Input), Input input)
{
    try {
        read(input);
    } catch (const Error& error) {
        const std::string text = error.what();
        require(error.kind() == ErrorKind::input, "bad input is an Error{input}");
        if (text.find('\n') != text.npos)
            std::fprintf(stderr, "%s\n", text.c_str());
        require(!text.empty() && text.find('\n') == text.npos, "an error is one line");
    }
}

}  // namespace lumel::fuzz
