#pragma once
// A window of lumel view on a display of its own, and the hand that xdotool moves there.

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <future>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "png_picture.h"
#include "program.h"

namespace lumel::test {

using Json = nlohmann::json;

inline constexpr auto kPatience = std::chrono::seconds(120);  ///< on a machine that has other work
inline constexpr auto kLook = std::chrono::milliseconds(50);

inline bool has_program(const std::string& name)
{
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// Until it is so.
template <class Truth>
bool wait_until(const Truth& truth)
{
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!truth()) {
        if (std::chrono::steady_clock::now() > end)
            return false;
        std::this_thread::sleep_for(kLook);
    }
    return true;
}

/// A display in memory, whose pixels lie in a file.
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
            const std::string number = std::to_string(ends[1]), folder = place_.path("");
            execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "800x600x24",
                   "-fbdir", folder.c_str(), "-nolisten", "tcp", static_cast<char*>(nullptr));
            _exit(127);
        }
        close(ends[1]);
        char letter = 0;
        while (read(ends[0], &letter, 1) == 1 && letter != '\n')
            name_ += letter;
        close(ends[0]);
        name_ = ":" + name_;
    }
    ~Display()
    {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    const std::string& name() const { return name_; }
    int hand(const std::string& does) const
    {
        return std::system(
            fmt::format("DISPLAY={} xdotool {} >/dev/null 2>&1", name_, does).c_str());
    }
    /// What is on it, from its top left. The file is in the form of xwd: a header of big-endian
    /// words, colours of 12 bytes, and rows of pixels of 4 bytes, blue first.
    Picture seen(int width, int height) const
    {
        const std::string bytes = bytes_of(place_.path("Xvfb_screen0"));
        const auto word = [&](std::size_t i) {
            std::uint32_t value = 0;
            for (std::size_t k = 0; k < 4; ++k)
                value = value << 8 | std::uint8_t(bytes[4 * i + k]);
            return std::size_t(value);
        };
        const std::size_t pixels = word(0) + 12 * word(19), row = word(12);
        Picture picture{width, height, {}};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (const std::size_t channel : {2u, 1u, 0u})
                    picture.rgb.push_back(std::uint8_t(
                        bytes[pixels + std::size_t(y) * row + 4 * std::size_t(x) + channel]));
        return picture;
    }

private:
    const Workplace place_;
    pid_t process_ = -1;
    std::string name_;
};

/// A window that plays a script and then stays, until it is closed.
class Window {
public:
    Window(const Display& display, const std::string& script,
           const std::vector<std::string>& more = {}, const std::string& size = "64")
        : display_(&display)
    {
        std::vector<std::string> arguments = {"view",     own_scene("cornell-box.gltf"),
                                              "--script", place.file("s.txt", script),
                                              "--folder", place.path("out"),
                                              "--size",   size,
                                              "--width",  "240",
                                              "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        outcome_ = std::async(std::launch::async, [arguments, name = display.name()] {
            return run_lumel(arguments,
                             {.environment = {"DISPLAY=" + name, "LIBGL_ALWAYS_SOFTWARE=1"}});
        });
    }
    ~Window()
    {
        if (outcome_.valid())
            close();
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool has_written(const std::string& name) const
    {
        return wait_until([&] { return !bytes_of(place.path("out/" + name)).empty(); });
    }
    /// Once keys go to it.
    bool is_there() const
    {
        return wait_until(
            [&] { return display_->hand("search --name lumel windowfocus --sync") == 0; });
    }
    /// What it shows, by the key P.
    Picture shoot()
    {
        display_->hand("mousemove 799 599 sleep 0.3 key p sleep 0.3");
        const std::string name = fmt::format("picture-{}.png", ++pictures_);
        EXPECT_TRUE(has_written(name));
        return read_picture(place.path("out/" + name));
    }
    /// The state that it reports at its end.
    Json close()
    {
        display_->hand("key ctrl+q");
        const Outcome outcome = end();
        const Json json = Json::parse(outcome.out, nullptr, false);
        EXPECT_FALSE(json.is_discarded()) << outcome.out;
        return json.is_discarded() ? json : json["state"];
    }
    Outcome end()
    {
        const Outcome outcome = outcome_.get();
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome;
    }

    const Workplace place;

private:
    const Display* display_;
    std::future<Outcome> outcome_;
    int pictures_ = 0;
};

/// A test with a display.
class ViewWindow : public ::testing::Test {
protected:
    static void SetUpTestSuite()
    {
        if (has_program("Xvfb") && has_program("xdotool"))
            display_.emplace();
    }
    static void TearDownTestSuite() { display_.reset(); }
    void SetUp() override
    {
        if (!display_)
            GTEST_SKIP() << "Xvfb or xdotool is not installed";
    }
    static const Display& display() { return *display_; }

private:
    static inline std::optional<Display> display_;
};

}  // namespace lumel::test
