// What the panel of lumel view solves: links anew, and other methods.

#include "window_on_display.h"

namespace lumel::test {
namespace {

class ViewWindowSolver : public ViewWindow {};

/// Clicks at a height of the panel, whose headers above that of the solver are closed first.
class SolverPanel {
public:
    SolverPanel(const Display& display, Window& window) : display_(&display), window_(&window)
    {
        window.hand("search --name lumel windowsize --sync 520 560");
        for (const int header : {17, 40, 63, 86})
            click(header);
    }
    void click(int y) const
    {
        point(y);
        window_->hand("click 1");
    }
    /// Writes into the field at a height. Keys are held for longer than a frame: the field misses
    /// keys that go down and up within one.
    void type(int y, const std::string& text) const
    {
        point(y);
        display_->hand("click 1 sleep 0.5 keydown End sleep 0.5 keyup End sleep 0.2 "
                       "keydown BackSpace sleep 1.5 keyup BackSpace sleep 0.2");
        display_->hand(fmt::format("type --delay 50 {}", text));
        window_->hand("sleep 0.2 keydown Return sleep 0.5 keyup Return");
    }
    /// What the panel shows where that button is while a method solves.
    Picture stop_button() const
    {
        const Picture seen = display_->seen(520, kStop + 5);
        Picture button{30, 10, {}};
        for (int y = kStop - 5; y < kStop + 5; ++y)
            for (int x = 250; x < 280; ++x)
                for (const int channel : seen.at(x, y))
                    button.rgb.push_back(static_cast<unsigned char>(channel));
        return button;
    }

    // Heights [pixels].
    static constexpr int kRays = 109, k16Rays = 151, kAtlas = 132, kSeed = 155, kAnew = 178,
                         kMethod = 206, kStochastic = 247, kGather = 315, kMethodSeed = 229,
                         kByLinks = 344, kByGather = 367, kByStochastic = 390, kStop = 390;

private:
    void point(int y) const { window_->hand(fmt::format("mousemove 270 {}", y)); }

    const Display* display_;
    Window* window_;
};

TEST_F(ViewWindowSolver, ThePanelSolvesAnewWithItsValues)
{
    const auto picked = [](Window& window) {
        for (const char* does : {"mousemove 120 400", "click 1"})
            window.hand(does);
        return window.shoot();
    };
    const std::string script = "exposure 1\nwait\nstate ready.json\n";
    Window window(display(), script);
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    const SolverPanel panel(display(), window);
    panel.click(SolverPanel::kRays);
    panel.click(SolverPanel::k16Rays);
    panel.type(SolverPanel::kAtlas, "32");
    panel.type(SolverPanel::kSeed, "7");
    panel.click(SolverPanel::kAnew);
    const Picture picture = picked(window);
    const Json state = window.close();
    ASSERT_NE(state["picked"], nullptr);
    EXPECT_EQ(state["links"]["count"], 16);

    // As of a session that began with them, and of none of the others.
    const auto begun = [&](const std::string& seed) {
        Window other(display(), script, {"--links", "16", "--seed", seed}, "32");
        EXPECT_TRUE(other.is_there());
        EXPECT_TRUE(other.has_written("ready.json"));
        other.hand("search --name lumel windowsize --sync 520 560");
        const Picture seen = picked(other);
        return std::pair(other.close(), seen);
    };
    const auto [same, seen] = begun("7");
    EXPECT_EQ(state["light"]["lumels"], same["light"]["lumels"]);
    EXPECT_EQ(state["picked"]["lumel"]["number"], same["picked"]["lumel"]["number"]);
    EXPECT_LE(difference(picture, seen).most, 1);
    const auto [unlike, other] = begun("8");
    EXPECT_GT(difference(picture, other).most, 4);
}

TEST_F(ViewWindowSolver, ThePanelSolvesByAMethodAndAKeyShowsLinksAgain)
{
    Window window(display(), "pick \"short block\"\nmove 0.1,0,0\nwait\nstate ready.json\n");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    const SolverPanel panel(display(), window);
    const Picture links = window.shoot();
    panel.click(SolverPanel::kMethod);
    panel.click(SolverPanel::kStochastic);
    panel.type(SolverPanel::kMethodSeed, "5");
    panel.click(SolverPanel::kByStochastic);
    Picture solved;
    ASSERT_TRUE(window.wait_until("another picture", [&] {
        solved = window.shoot();
        return difference(links, solved).mean > 0.0;
    }));
    EXPECT_LT(difference(links, solved).mean, 5.0);
    window.hand("key l");
    EXPECT_EQ(window.shoot().rgb, links.rgb);
    window.hand("key l");
    EXPECT_EQ(window.shoot().rgb, solved.rgb);
    const Json state = window.close();
    EXPECT_EQ(state["solved"]["method"], "stochastic");
    EXPECT_EQ(state["solved"]["options"]["seed"], 5);
    EXPECT_EQ(state["solved"]["shown"], true);
    EXPECT_EQ(state["solved"]["stopped"], false);
}

TEST_F(ViewWindowSolver, AnEditEndsWhatIsBeingSolved)
{
    Window window(display(), "pick \"short block\"\nwait\nstate ready.json\n", {}, "128");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    const SolverPanel panel(display(), window);
    panel.click(SolverPanel::kMethod);
    panel.click(SolverPanel::kGather);
    const Picture before = panel.stop_button();
    panel.click(SolverPanel::kByGather);
    ASSERT_TRUE(window.wait_until("no button that stops",
                                  [&] { return panel.stop_button().rgb != before.rgb; }));
    window.hand("mousemove 799 599 key r");
    const Json state = window.close();
    EXPECT_EQ(state["solved"], nullptr);
    EXPECT_GT(state["light"]["links_traced_again"], 0);  // they followed
}

TEST_F(ViewWindowSolver, WhatIsBeingSolvedCanBeStopped)
{
    // All of its hemicubes would take minutes.
    Window window(display(), "wait\nstate ready.json\n", {}, "256");
    ASSERT_TRUE(window.is_there());
    ASSERT_TRUE(window.has_written("ready.json"));
    const SolverPanel panel(display(), window);
    const Picture links = window.shoot();
    panel.click(SolverPanel::kMethod);
    panel.click(SolverPanel::kGather);
    EXPECT_TRUE(window.wait_until("no other picture of what was stopped", [&] {
        panel.click(SolverPanel::kByGather);
        display().hand("sleep 2");
        panel.click(SolverPanel::kStop);
        return difference(links, window.shoot()).mean > 1.0;
    }));
    const Json solved = window.close()["solved"];
    EXPECT_EQ(solved["method"], "gather");
    EXPECT_EQ(solved["stopped"], true);
}

}  // namespace
}  // namespace lumel::test
