#pragma once
// A window of lumel view on a display of its own.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "display.h"
#include "png_picture.h"
#include "program.h"

namespace lumel::test {

using Json = nlohmann::json;

/// A window that plays a script and then stays open until it is closed. Waits end as soon as the
/// window or its display has ended; their failure names what was missing.
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
        outcome_ = std::async(std::launch::async, [this, arguments] {
            return run_lumel(
                arguments,
                {.environment = {"DISPLAY=" + display_->name(), "LIBGL_ALWAYS_SOFTWARE=1"},
                 .on_start = [this](pid_t started) { process_ = started; }});
        });
    }
    ~Window()
    {
        if (!is_read_)
            close();
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Waits until `truth` holds, for at most kPatience. what: the sentence of a failure.
    template <class Truth>
    ::testing::AssertionResult wait_until(const std::string& what, const Truth& truth) const
    {
        constexpr auto kLook = std::chrono::milliseconds(20);
        const auto end = std::chrono::steady_clock::now() + kPatience;
        while (true) {
            const std::string missing = missing_now();
            if (truth())
                return ::testing::AssertionSuccess();
            if (!missing.empty())
                return ::testing::AssertionFailure() << what << ": " << missing;
            if (std::chrono::steady_clock::now() > end)
                return ::testing::AssertionFailure() << what << " in " << kPatience.count() << " s";
            std::this_thread::sleep_for(kLook);
        }
    }
    ::testing::AssertionResult has_written(const std::string& name) const
    {
        return wait_until("no " + name, [&] { return is_written(name); });
    }
    /// Keys go to the window from now on.
    ::testing::AssertionResult is_there() const
    {
        return wait_until("no window that takes keys", [&] {
            return display_->try_hand("search --name lumel windowfocus --sync") == 0;
        });
    }

    /// Returns the picture that the key P writes. All earlier input is in it: the window handles
    /// events in their order.
    Picture shoot()
    {
        const std::string name = fmt::format("picture-{}.png", ++pictures_);
        // Keys pressed while links are traced are lost: the key is pressed again.
        constexpr auto kBetweenKeys = std::chrono::seconds(5);
        auto again = std::chrono::steady_clock::now();
        EXPECT_TRUE(wait_until("no " + name + " by the key P", [&] {
            if (is_written(name))
                return true;
            if (const auto now = std::chrono::steady_clock::now(); now >= again) {
                display_->hand("key p");
                again = now + kBetweenKeys;
            }
            return false;
        }));
        return is_written(name) ? read_picture(place.path("out/" + name)) : Picture{};
    }
    /// Sends mouse and keys, and waits until the window has handled them: two pictures, since a
    /// button is released in the frame after its press.
    void hand(const std::string& does)
    {
        display_->hand(does);
        shoot();
        shoot();
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
    /// Waits for its end; a window that does not end is killed.
    Outcome end()
    {
        is_read_ = true;
        const auto ended = wait_until("the window does not end", [&] { return has_ended(); });
        EXPECT_TRUE(has_ended()) << ended.message();
        if (!has_ended())
            kill(process_, SIGKILL);
        EXPECT_EQ(outcome_.get().code, 0) << outcome_.get().err;
        return outcome_.get();
    }

    const Workplace place;

private:
    bool has_ended() const
    {
        return outcome_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }
    bool is_written(const std::string& name) const
    {
        return !bytes_of(place.path("out/" + name)).empty();
    }
    /// A sentence if the display or the window has ended, else empty.
    std::string missing_now() const
    {
        if (std::string display = display_->missing(); !display.empty())
            return display;
        return has_ended() ? fmt::format("the window has ended with code {}: {}",
                                         outcome_.get().code, outcome_.get().err)
                           : "";
    }

    const Display* display_;
    std::atomic<pid_t> process_ = -1;
    std::shared_future<Outcome> outcome_;
    bool is_read_ = false;
    int pictures_ = 0;
};

/// A test with a display of its own.
class ViewWindow : public ::testing::Test {
protected:
    void SetUp() override
    {
        if (!has_program("Xvfb") || !has_program("xdotool"))
            GTEST_SKIP() << "Xvfb or xdotool is not installed";
        display_.emplace();
    }
    const Display& display() const { return *display_; }

private:
    std::optional<Display> display_;
};

}  // namespace lumel::test
