#include "program.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <future>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../support/source_folder.h"

namespace lumel::test {
namespace {

constexpr std::chrono::milliseconds kBetweenSignals(20);

struct Channel {
    int ours = -1;
    int theirs = -1;
};

Channel make_pipe()
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw std::runtime_error("pipe2 failed");
    return {ends[0], ends[1]};
}

Channel make_terminal()
{
    Channel channel;
    winsize size = {};
    size.ws_row = 25;
    size.ws_col = 100;
    if (openpty(&channel.ours, &channel.theirs, nullptr, nullptr, &size) != 0)
        throw std::runtime_error("openpty failed");
    return channel;
}

/// Reads both ends until the program has closed them; calls `on_output` after each piece.
void collect(int out, int err, Outcome& outcome, const std::function<void()>& on_output)
{
    std::array<pollfd, 2> ends = {pollfd{out, POLLIN, 0}, pollfd{err, POLLIN, 0}};
    std::array<char, 4096> buffer;
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        poll(ends.data(), ends.size(), -1);
        for (pollfd& end : ends) {
            if (end.fd < 0 || end.revents == 0)
                continue;
            const ssize_t count = read(end.fd, buffer.data(), buffer.size());
            // A terminal whose other side is closed gives an error, a pipe gives 0.
            if (count <= 0)
                end.fd = -1;
            else
                (&end == &ends[0] ? outcome.out : outcome.err)
                    .append(buffer.data(), static_cast<std::size_t>(count));
        }
        on_output();
    }
}

/// Kills a process after a time [s], unless it goes before.
class Killer {
public:
    Killer(pid_t process, double seconds)
        : thread_([process, seconds, end = end_.get_future()] {
              if (end.wait_for(std::chrono::duration<double>(seconds)) ==
                  std::future_status::timeout)
                  kill(process, SIGKILL);
          })
    {
    }
    ~Killer()
    {
        end_.set_value();
        thread_.join();
    }
    Killer(const Killer&) = delete;
    Killer& operator=(const Killer&) = delete;

private:
    std::promise<void> end_;
    std::thread thread_;
};

[[noreturn]] void become(std::string program, std::vector<std::string> arguments,
                         std::vector<std::string> environment, int out, int err)
{
    for (std::string& setting : environment)
        putenv(setting.data());
    std::vector<char*> values = {program.data()};
    for (std::string& argument : arguments)
        values.push_back(argument.data());
    values.push_back(nullptr);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    // Whatever the test runner ignores, a user's shell does not.
    signal(SIGINT, SIG_DFL);
    execvp(values[0], values.data());
    _exit(127);
}

}  // namespace

std::string lumel_program()
{
    return LUMEL_PROGRAM;
}

Outcome run_lumel(const std::vector<std::string>& arguments, const RunOptions& options)
{
    return run_program(lumel_program(), arguments, options);
}

Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                    const RunOptions& options)
{
    const Channel out = make_pipe();
    const bool interrupts = !options.interrupt_at.empty();
    const Channel err = options.terminal || interrupts ? make_terminal() : make_pipe();
    const pid_t child = fork();
    if (child == 0)
        become(program, arguments, options.environment, out.theirs, err.theirs);
    close(out.theirs);
    close(err.theirs);
    if (options.on_start)
        options.on_start(child);

    std::optional<Killer> killer;
    if (options.kill_after > 0.0)
        killer.emplace(child, options.kill_after);
    Outcome outcome;
    bool sent = false;
    collect(out.ours, err.ours, outcome, [&] {
        if (!interrupts || sent || outcome.err.find(options.interrupt_at) == std::string::npos)
            return;
        for (int n = 0; n < options.signals; ++n) {
            if (n > 0)
                std::this_thread::sleep_for(kBetweenSignals);
            kill(child, options.signal);
        }
        sent = true;
    });
    // Not after the child is waited for, when its number may be another's.
    killer.reset();
    int status = 0;
    rusage usage = {};
    wait4(child, &status, 0, &usage);
    constexpr std::uint64_t kKibibyte = 1024;  // the unit of ru_maxrss on Linux
    outcome.peak_bytes = std::uint64_t(usage.ru_maxrss) * kKibibyte;
    close(out.ours);
    close(err.ours);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

Workplace::Workplace()
{
    std::string name = (std::filesystem::temp_directory_path() / "lumel-cli-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("mkdtemp failed");
    folder_ = name;
}

Workplace::~Workplace()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::string Workplace::file(const std::string& name, const std::string& bytes) const
{
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
}

std::vector<std::string> Workplace::listing() const
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
        names.push_back(std::filesystem::relative(entry.path(), folder_).string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string own_scene(const std::string& name)
{
    return support::source_path("scenes/" + name);
}

std::string bytes_of(const std::string& path)
{
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

void expect_one_sentence(const Outcome& outcome, int code, const std::vector<std::string>& words)
{
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& word : words)
        EXPECT_NE(outcome.err.find(word), std::string::npos)
            << word << " is not in: " << outcome.err;
}

}  // namespace lumel::test
