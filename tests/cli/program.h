#pragma once
// The built program as a user meets it: arguments in, exit code, stdout, stderr and files out.

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace lumel::test {

struct RunOptions {
    bool terminal = false;       ///< stderr is a terminal of 100 columns
    std::string interrupt_at{};  ///< send `signal` once stderr, a terminal, shows this text
    int signal = SIGINT;
    int signals = 1;                         ///< number of them, 20 ms apart
    double kill_after = 0.0;                 ///< send SIGKILL after so long [s]; 0: never
    std::vector<std::string> environment{};  ///< NAME=VALUE, beside that of the test
    std::function<void(pid_t)> on_start{};   ///< called with the number of its process
};

struct Outcome {
    int code = -1;  ///< exit code, or 128 + the signal that ended it
    std::string out;
    std::string err;
    std::uint64_t peak_bytes = 0;  ///< largest resident size that the system has seen
};

/// The built program.
std::string lumel_program();

/// Runs lumel to its end.
Outcome run_lumel(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// The same for another program, which is searched for as a shell does.
Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                    const RunOptions& options = {});

/// A fresh folder for one test, removed with all it holds.
class Workplace {
public:
    Workplace();
    ~Workplace();
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    /// Writes a file and gives its path.
    std::string file(const std::string& name, const std::string& bytes) const;
    /// Names of everything in it, hidden files included, sorted.
    std::vector<std::string> listing() const;

private:
    std::filesystem::path folder_;
};

/// A scene of the project's own.
std::string own_scene(const std::string& name);

/// All bytes of a file; empty if there is none.
std::string bytes_of(const std::string& path);

/// True if a text contains another.
bool has(const std::string& text, const std::string& part);

/// Passes if `outcome` is a failure with this exit code that prints one line on stderr, nothing on
/// stdout, and names all of `words`.
void expect_one_sentence(const Outcome& outcome, int code, const std::vector<std::string>& words);

}  // namespace lumel::test
