// Limits of time, error and memory, as a bake keeps them.

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "base/core/error.h"
#include "base/core/log.h"
#include "jobs/solve/memory_plan.h"
#include "jobs/solve/setting.h"
#include "methods/methods.h"

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

TEST(Time, ThatWasTooShortForTheFirstLightIsAWarning)
{
    const ProgressFunction nobody;
    const auto warnings = [&](double max_seconds) {
        const LogCapture silence;
        Stages stages(nobody);
        SlowSolver solver;
        solve_in_stage(solver, {.max_shots = 9, .max_seconds = max_seconds, .target_error = 0.0},
                       stages);
        return stages.warnings();
    };
    EXPECT_TRUE(warnings(100.0).empty());
    EXPECT_TRUE(warnings(0.0).empty());
    ASSERT_EQ(warnings(1e-9).size(), 1u);
    EXPECT_EQ(warnings(1e-9)[0].find(
                  "the time limit of 1e-09 s was too short: all lumels had their first light"),
              0u);
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

constexpr std::uint64_t kMebibyte = 1 << 20;
const gpu::DeviceInfo kCard{.name = "Card",
                            .type = "discrete",
                            .memory_bytes = 800 * kMebibyte,
                            .free_bytes = 100 * kMebibyte};
const gpu::DeviceInfo kSoftware{
    .name = "llvmpipe", .type = "cpu", .memory_bytes = kMebibyte, .free_bytes = kMebibyte};

/// What is said of a bake of 1024 × 1024 texels that takes `device` and `host` [MiB].
std::string shortage_of(std::uint64_t device, std::uint64_t host, const MemoryLimits& limits)
{
    return shortage({.solver = device * kMebibyte}, {.lumels = host * kMebibyte}, 1024, limits);
}

TEST(Memory, IsThatOfTheSideToWhichAMapIsLimited)
{
    const Scene scene = read_gltf(support::source_path("scenes/cornell-box.gltf"));
    const MemoryLimits limits = memory_limits(0, kSoftware, 1000 * kMebibyte);
    for (const int pages : {1, 4}) {
        BakeOptions options{.atlas = {.size = 4096, .max_size = 64, .pages = pages}};
        EXPECT_NO_THROW(check_memory(scene, options, limits));
        options.atlas.max_size = 4096;
        EXPECT_THROW(check_memory(scene, options, limits), Error);
    }
}

TEST(Memory, ThatIsNotThereIsASentenceWithASizeThatFits)
{
    const MemoryLimits card = memory_limits(0, kCard, 500 * kMebibyte);
    EXPECT_EQ(shortage_of(100, 500, card), "");
    const std::string sentence = shortage_of(400, 1, card);
    for (const char* part : {"400.0 MiB of graphics memory", "Card has 100.0 MiB", "1024 × 1024",
                             "--size 480 or less"})  // half, and some to spare
        EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    EXPECT_NE(shortage_of(1, 501, card).find("501.0 MiB of host memory"), std::string::npos);
    EXPECT_EQ(shortage_of(101, 1, memory_limits(0, kSoftware, 500 * kMebibyte)), "");
    EXPECT_NE(shortage_of(501, 1, memory_limits(0, kSoftware, 500 * kMebibyte)), "");
    EXPECT_EQ(shortage_of(501, 1, memory_limits(0, kSoftware, 0)), "");
}

// Matrices grow with the square of the patches, whatever the side of the map.
TEST(Memory, ThatAMatrixDoesNotHaveIsASentenceWithFewerPatches)
{
    const MemoryLimits limits = memory_limits(0, kCard, 500 * kMebibyte);
    const HostMemory host{.lumels = 100 * kMebibyte, .matrices = 1600 * kMebibyte, .patches = 4096};
    const std::string sentence = shortage({}, host, 64, limits);
    for (const char* part : {"a matrix of 4096 patches", "1700.0 MiB of host memory", "500.0 MiB",
                             "--patches 1942 or fewer"})  // half, and some to spare
        EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    const MemoryLimits little = memory_limits(0, kCard, 50 * kMebibyte);
    EXPECT_NE(shortage({}, host, 64, little).find("--size"), std::string::npos);
}

TEST(Memory, OfAMatrixIsRefusedBeforeTheBake)
{
    const Scene scene = read_gltf(support::source_path("scenes/cornell-box.gltf"));
    MatrixOptions matrix;
    matrix.transport.patches = 16384;
    const BakeOptions options{.atlas = {.size = 128}, .solver = {.method = matrix}};
    try {
        check_memory(scene, options, memory_limits(0, kSoftware, 4000 * kMebibyte));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("--patches"), std::string::npos) << error.what();
    }
}

TEST(Memory, ThatIsAllowedBoundsDeviceAndHostEach)
{
    const MemoryLimits limits = memory_limits(200 * kMebibyte, kCard, 50 * kMebibyte);
    EXPECT_EQ(shortage_of(200, 200, limits), "");
    for (const std::string& sentence : {shortage_of(201, 1, limits), shortage_of(1, 201, limits)})
        EXPECT_NE(sentence.find("--max-memory allows 200.0 MiB"), std::string::npos) << sentence;
}

TEST(Memory, OfSweepsIsWhatTheDeviceHasLeft)
{
    const SolveScene prepared(support::source_path("scenes/cornell-box.gltf"), {.size = 64});
    const BakeOptions options{.solver = {.method = LinksOptions{.rays = Rays::tree}}};
    const auto limit = [&](const gpu::DeviceInfo& device, std::uint64_t available) {
        BakeOptions limited = options;
        limit_links(limited, prepared, memory_limits(0, device, available));
        return limited.solver.max_device_bytes;
    };
    const GraphicsMemory graphics = graphics_memory(prepared, options, kCard);
    ASSERT_GT(graphics.sweeps, 0u);
    EXPECT_EQ(limit(kCard, 500 * kMebibyte), kCard.free_bytes - graphics.least());
    gpu::DeviceInfo full = kCard;
    full.free_bytes = kMebibyte;
    EXPECT_EQ(limit(full, 500 * kMebibyte), 1u);
    // In the host's memory, what most scenes need, or nothing.
    EXPECT_EQ(limit(kSoftware, 4000 * kMebibyte), graphics.sweeps);
    EXPECT_EQ(limit(kSoftware, kMebibyte), 1u);
}

}  // namespace
}  // namespace lumel
