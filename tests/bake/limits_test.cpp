// Limits of time, error and memory, as a bake keeps them.

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "bake/setting.h"
#include "bake/shortage.h"
#include "core/log.h"
#include "solve/solver.h"

namespace lumel {
namespace {

TEST(Time, CountsFromTheBeginningOfABake)
{
    const ProgressFunction nobody;
    const Stages stages(nobody);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    const SolverOptions left = for_what_is_left({.max_seconds = 100.0}, stages);
    EXPECT_LE(left.max_seconds, 99.94);
    EXPECT_GT(left.max_seconds, 0.0);
    // What is used up is still a limit, and no limit stays none.
    EXPECT_GT(for_what_is_left({.max_seconds = 0.01}, stages).max_seconds, 0.0);
    EXPECT_LT(for_what_is_left({.max_seconds = 0.01}, stages).max_seconds, 0.01);
    EXPECT_EQ(for_what_is_left({.max_seconds = 0.0}, stages).max_seconds, 0.0);
}

/// Has light after a few steps.
class SlowSolver : public Solver {
public:
    void step() override { ++steps; }
    SolverState state() const override { return {.shots = steps < kDark ? 0u : steps}; }
    std::vector<glm::vec3> irradiance() override { return {}; }
    const gpu::StageTimes& times() const override { return times_; }
    double longest_submission() const override { return 0.0; }

    static constexpr unsigned kDark = 7;
    unsigned steps = 0;

private:
    gpu::StageTimes times_;
};

TEST(Time, DoesNotEndABakeBeforeThereIsLight)
{
    SlowSolver solver;
    EXPECT_TRUE(solve(solver, {.max_seconds = 1e-9, .target_error = 0.0}));
    EXPECT_EQ(solver.steps, SlowSolver::kDark);
}

TEST(Error, ThatWasMissedIsAWarning)
{
    const ProgressFunction nobody;
    const auto warnings = [&](const SolverOptions& options, const SolverState& state) {
        const LogCapture silence;
        Stages stages(nobody);
        tell_missed(options, state, stages);
        EXPECT_EQ(silence.messages(), stages.warnings());
        return stages.warnings();
    };
    EXPECT_TRUE(
        warnings({.max_shots = 9, .target_error = 0.02}, {.shots = 9, .error = 0.02}).empty());
    EXPECT_TRUE(
        warnings({.max_shots = 9, .target_error = 0.0}, {.shots = 9, .error = 0.3}).empty());
    EXPECT_TRUE(warnings({.target_error = 0.04}, {.shots = 9, .error = 0.041})
                    .empty());  // no limit ended it
    ASSERT_EQ(warnings({.max_shots = 9, .target_error = 0.04}, {.shots = 9, .error = 0.38}).size(),
              1u);
    EXPECT_EQ(warnings({.max_shots = 9, .target_error = 0.04}, {.shots = 9, .error = 0.38})[0],
              "the estimated error is 38 %, not the 4 % asked for: the limit of shots or time was "
              "reached first");
    EXPECT_EQ(warnings({.max_shots = 9, .target_error = 0.04}, {.shots = 9, .error = -1.0}).size(),
              1u);
    EXPECT_EQ(warnings({.max_shots = 9, .target_error = 0.04, .target_dark_error = 0.1},
                       {.shots = 9, .error = 0.01, .dark_error = 0.2})
                  .size(),
              1u);
}

TEST(Memory, ThatIsNotThereIsASentence)
{
    constexpr std::uint64_t kMebibyte = 1 << 20;
    const gpu::DeviceInfo card{.name = "Card", .type = "discrete", .memory_bytes = 100 * kMebibyte};
    const gpu::DeviceInfo software{.name = "llvmpipe", .type = "cpu", .memory_bytes = kMebibyte};
    EXPECT_EQ(shortage(100 * kMebibyte, card, 50 * kMebibyte), "");
    const std::string sentence = shortage(101 * kMebibyte, card, 500 * kMebibyte);
    EXPECT_NE(sentence.find("101.0 MiB"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("Card has 100.0 MiB"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("--size"), std::string::npos) << sentence;
    EXPECT_EQ(shortage(101 * kMebibyte, software, 500 * kMebibyte), "");
    EXPECT_NE(shortage(501 * kMebibyte, software, 500 * kMebibyte), "");
    EXPECT_EQ(shortage(501 * kMebibyte, software, 0), "");
}

}  // namespace
}  // namespace lumel
