// lumel: bakes the light of a glTF scene into lightmaps. See README.md.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "base/core/error.h"
#include "commands.h"
#include "interrupt.h"

namespace {

using namespace lumel;

int exit_code(ErrorKind kind)
{
    switch (kind) {
    case ErrorKind::input:
        return kExitInput;
    case ErrorKind::device:
        return kExitDevice;
    case ErrorKind::output:
        return kExitOutput;
    case ErrorKind::stopped:
        return interrupt_exit_code();
    }
    return kExitUnexpected;
}

/// Whatever went wrong fits one line.
int fail(int code, std::string sentence)
{
    std::replace(sentence.begin(), sentence.end(), '\n', ' ');
    std::fprintf(stderr, "error: %s\n", sentence.c_str());
    return code;
}

}  // namespace

int main(int count, char** values)
{
    try {
        const Arguments arguments = parse_arguments(count, values);
        const int code =
            std::visit([](const auto& given) { return run(given); }, arguments.of_command);
        if (std::fflush(stdout) != 0)
            return fail(kExitOutput, "standard output cannot be written");
        return code;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::stopped) {
            std::fprintf(stderr, "%s\n", error.what());
            return exit_code(error.kind());
        }
        return fail(exit_code(error.kind()), error.what());
    } catch (const std::bad_alloc&) {
        return fail(kExitDevice,
                    "not enough memory; try fewer --texels-per-metre or a smaller --size");
    } catch (const std::exception& error) {
        return fail(kExitUnexpected, std::string("unexpected: ") + error.what());
    }
}
