#pragma once
// A display in memory, and the mouse and keys that xdotool sends to it.

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "png_picture.h"
#include "program.h"

namespace lumel::test {

/// Longest wait, on a machine that has other work.
inline constexpr auto kPatience = std::chrono::seconds(120);

inline bool has_program(const std::string& name)
{
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// An X server whose pixels are in a file. It ends with this object, or with the test program.
class Display {
public:
    Display()
    {
        int ends[2];
        if (pipe(ends) != 0)
            throw std::runtime_error("pipe failed");
        process_ = fork();
        if (process_ == 0) {
            close(ends[0]);
            become_server(ends[1]);
        }
        close(ends[1]);
        name_ = read_number(ends[0]);
        name_.insert(name_.begin(), ':');
        close(ends[0]);
        if (name_.size() == 1)
            throw std::runtime_error("Xvfb does not start: " + missing());
    }
    ~Display()
    {
        if (process_ < 0)
            return;
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    const std::string& name() const { return name_; }

    /// A sentence if the server has ended, else empty.
    std::string missing() const
    {
        int status = 0;
        if (process_ >= 0 && waitpid(process_, &status, WNOHANG) == process_) {
            process_ = -1;
            end_ = WIFSIGNALED(status) ? fmt::format("by signal {}", WTERMSIG(status))
                                       : fmt::format("with code {}", WEXITSTATUS(status));
        }
        return process_ >= 0 ? ""
                             : fmt::format("the display {} has ended {}: {}", name_, end_,
                                           bytes_of(place_.path("errors")));
    }

    /// Returns the exit code of xdotool, which is stopped after 30 s.
    int try_hand(const std::string& does) const
    {
        return std::system(
            fmt::format("DISPLAY={} timeout 30 xdotool {} >/dev/null 2>&1", name_, does).c_str());
    }
    void hand(const std::string& does) const
    {
        EXPECT_EQ(try_hand(does), 0) << "xdotool " << does << ": " << missing();
    }

    /// What is on it, from its top left. The file is in the form of xwd: a header of big-endian
    /// words, colours of 12 bytes, and rows of pixels of 4 bytes, blue first.
    Picture seen(int width, int height) const
    {
        const std::string bytes = bytes_of(place_.path("Xvfb_screen0"));
        const auto word = [&](std::size_t i) {
            std::uint32_t value = 0;
            for (std::size_t k = 0; k < 4; ++k)
                value = value << 8 | std::uint8_t(bytes.at(4 * i + k));
            return std::size_t(value);
        };
        const std::size_t pixels = word(0) + 12 * word(19), row = word(12);
        Picture picture{width, height, {}};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (const std::size_t channel : {2u, 1u, 0u})
                    picture.rgb.push_back(std::uint8_t(
                        bytes.at(pixels + std::size_t(y) * row + 4 * std::size_t(x) + channel)));
        return picture;
    }

private:
    [[noreturn]] void become_server(int number_to) const
    {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        const std::string number = std::to_string(number_to), folder = place_.path("");
        dup2(open(place_.path("errors").c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        // Without -noreset the server restarts whenever its last client leaves, and refuses clients
        // that connect meanwhile.
        execlp("Xvfb", "Xvfb", "-noreset", "-displayfd", number.c_str(), "-screen", "0",
               "800x600x24", "-fbdir", folder.c_str(), "-nolisten", "tcp",
               static_cast<char*>(nullptr));
        _exit(127);
    }
    /// Returns the display number; empty if the server ends or takes longer than kPatience.
    static std::string read_number(int from)
    {
        constexpr int kWait = int(std::chrono::milliseconds(kPatience).count());
        std::string number;
        for (char letter = 0; letter != '\n';) {
            pollfd end{from, POLLIN, 0};
            if (poll(&end, 1, kWait) != 1 || read(from, &letter, 1) != 1)
                return "";
            if (letter != '\n')
                number += letter;
        }
        return number;
    }

    const Workplace place_;
    mutable pid_t process_ = -1;  ///< -1: ended
    mutable std::string end_;
    std::string name_;
};

}  // namespace lumel::test
