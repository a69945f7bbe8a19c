// lumel: bakes the light of a glTF scene into lightmaps. See README.md.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "base/core/error.h"
#include "base/core/huge_pages.h"
#include "base/core/log.h"
#include "base/ranks/ranks.h"
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
        return interrupted() ? interrupt_exit_code() : kExitDone;  // else another rank was stopped
    }
    return kExitUnexpected;
}

/// How the program ends after an exception.
struct Failure {
    int code;
    std::string sentence;
};

/// Whatever went wrong fits one line.
Failure in_one_line(Failure failure)
{
    std::ranges::replace(failure.sentence, '\n', ' ');
    return failure;
}

Failure failure_of(const std::exception_ptr& thrown)
{
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
        const char* const before = error.kind() == ErrorKind::stopped ? "" : "error: ";
        return {exit_code(error.kind()), before + std::string(error.what())};
    } catch (const std::bad_alloc&) {
        return {kExitDevice,
                "error: not enough memory; try fewer --texels-per-metre or a smaller --size"};
    } catch (const std::exception& error) {
        return {kExitUnexpected, std::string("error: unexpected: ") + error.what()};
    }
}

int run_command(int count, char** values)
{
    const Arguments arguments = parse_arguments(count, values);
    const int code = std::visit([](const auto& given) { return run(given); }, arguments.of_command);
    if (std::fflush(stdout) != 0)
        throw Error(ErrorKind::output, "", "standard output cannot be written");
    return code;
}

/// Runs as one of the processes that share a bake. Only the first writes and talks.
int run_rank(Ranks& ranks, int count, char** values)
{
    std::optional<LogCapture> silence;
    if (!ranks.is_first())
        silence.emplace();
    const Arguments arguments = parse_arguments(count, values);
    const auto* given = std::get_if<BakeArguments>(&arguments.of_command);
    if (!given)
        throw Error(ErrorKind::input, "mpirun",
                    "can start lumel bake only; run other commands without it");
    BakeArguments own = *given;
    if (!ranks.is_first()) {
        own.page = false;
        own.talk = {.quiet = true, .progress = ProgressStyle::none};
    }
    const int code = run(own, &ranks);
    std::fflush(stdout);
    return code;
}

}  // namespace

int main(int count, char** values)
{
    // Program, command, arguments: help and lists need little memory.
    constexpr int kWithArguments = 3;
    if (count >= kWithArguments)
        use_huge_pages(values);
    std::unique_ptr<Ranks> ranks;
    int code = kExitDone;
    try {
        ranks = started_ranks(LUMEL_VERSION);
        if (ranks)
            ranks->together([&] { code = run_rank(*ranks, count, values); });
        else
            code = run_command(count, values);
    } catch (...) {
        const Failure failure = in_one_line(failure_of(std::current_exception()));
        if (!ranks || ranks->speaks())
            std::fprintf(stderr, "%s\n", failure.sentence.c_str());
        code = failure.code;
    }
    if (ranks)
        ranks->finish(code);
    return code;
}
