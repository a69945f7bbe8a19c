// [BSS05] section 6: "frame to frame coherence can be easily exploited. In case of moving objects
// [...] we can take the previous solution as a good guess to start the iteration."

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/moving.h"
#include "bench/papers/our_default.h"
#include "bench/stopwatch.h"
#include "jobs/solve/setting.h"
#include "methods/glossy/glossy.h"
#include "truth/reference.h"

namespace lumel::bench {
namespace {

/// Frames that are not counted: the first has none before it.
constexpr int kUncounted = 1;

/// One frame of a scene in which a thing turns, with two halves of its truth.
struct Frame {
    Frame(const FramesSettings& settings, Scene posed, const std::optional<Atlas>& atlas,
          const SolverOptions& options, const gpu::Device& device)
        : world(std::move(posed),
                [&](const Scene& scene, const RayScene&, const ProgressCallback& progress) {
                    return atlas ? *atlas
                                 : make_atlas(scene, {.size = settings.shared.size}, progress);
                }),
          near(near_field_for(world.scene, world.rays, world.lumels, options)),
          resident(device, world.scene, world.lumels, &world.atlas),
          particles(world)
    {
        for (std::uint32_t h = 0; h < 2; ++h)
            truth[h] = reference_irradiance(
                world.scene, world.rays, world.lumels,
                {.samples_per_lumel = settings.shared.reference_spp, .seed = 99 + h});
    }

    SolveScene world;
    NearField near;
    World resident;
    LobeParticles particles;
    std::vector<glm::vec3> truth[2];
};

/// How a frame begins.
struct Manner {
    const char* name;
    bool goes_on;  ///< from the light of the frame before
    float kept;    ///< of its average, in terms of a frame's iterations
    bool same;     ///< the same random numbers in every frame
};

constexpr Manner kManners[] = {
    {"from nothing, other numbers", false, 0.0f, false},
    {"from nothing, the same numbers", false, 0.0f, true},
    {"from the frame before", true, 0.0f, true},
    {"and half its average", true, 0.5f, false},
    {"and its average", true, 1.0f, false},
};

/// Sums over frames of what is wrong.
class Errors {
public:
    void add(const Frame& frame, const std::vector<glm::vec3>& found, bool counts)
    {
        std::vector<glm::dvec3> wrong;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const glm::dvec3 a(frame.truth[0][i]), b(frame.truth[1][i]), value(found[i]);
            wrong.push_back(value - 0.5 * (a + b));
            if (!counts)
                continue;
            // Free of the noise of the truth.
            square_ += glm::dot(value - a, value - b);
            if (!before_.empty()) {
                const glm::dvec3 change = wrong[i] - before_[i];
                changes_ += glm::dot(change, change);
            }
            bias_ += wrong[i].r + wrong[i].g + wrong[i].b;
            sum_ += 0.5 * (a.r + a.g + a.b + b.r + b.g + b.b);
            count_ += 3.0;
        }
        before_ = std::move(wrong);
    }

    bool empty() const { return count_ == 0.0; }
    double rmse() const { return std::sqrt(std::max(square_, 0.0) * count_) / sum_; }
    double flicker() const { return std::sqrt(changes_ * count_) / sum_; }
    double bias() const { return bias_ / sum_; }

private:
    double square_ = 0.0, changes_ = 0.0, bias_ = 0.0, sum_ = 0.0, count_ = 0.0;
    std::vector<glm::dvec3> before_;
};

/// Each frame solved anew.
Cell by_our_default(const std::vector<std::unique_ptr<Frame>>& frames, const gpu::Device& device)
{
    Errors errors;
    double cpu = 0.0;
    for (std::size_t f = kUncounted; f < frames.size(); ++f) {
        const Solved ours = solve_by_default(device, frames[f]->world);
        errors.add(*frames[f], ours.irradiance, true);
        cpu += ours.cpu / double(frames.size() - kUncounted);
    }
    return words_of(errors.rmse(), cpu);
}

/// from_nothing: errors of frames that begin so, set by the first manner.
void play(const std::vector<std::unique_ptr<Frame>>& frames, const GlossyOptions& options,
          int iterations, const Manner& manner, const gpu::Device& device, Errors& from_nothing,
          Report& report)
{
    Errors errors;
    Stopwatch watch;
    std::unique_ptr<GlossyIllumination> before;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const Frame& frame = *frames[f];
        GlossyOptions own = options;
        own.seed += manner.same ? 0 : std::uint32_t(f);
        auto solver = std::make_unique<GlossyIllumination>(
            device, frame.resident, frame.world.lumels, frame.near, own,
            std::span<const glm::vec3>{}, &frame.particles);
        const bool counts = int(f) >= kUncounted;
        if (counts)
            watch.start();
        if (before && manner.goes_on)
            solver->go_on_from(*before, manner.kept * float(iterations));
        for (int i = 0; i < iterations; ++i)
            solver->step();
        const std::vector<glm::vec3> found = solver->irradiance();
        if (counts)
            watch.stop();
        errors.add(frame, found, counts);
        before = std::move(solver);
    }
    if (from_nothing.empty())
        from_nothing = errors;
    const double counted = double(frames.size()) - kUncounted;
    report.row({options.scheme == Scheme::paper ? "paper" : "phased", iterations, manner.name,
                fixed(100.0 * errors.rmse(), 2), signed_fixed(100.0 * errors.bias(), 2),
                fixed(100.0 * errors.flicker(), 2), fixed(watch.cpu / counted, 3),
                fixed(errors.rmse() / from_nothing.rmse(), 2),
                fixed(errors.flicker() / from_nothing.flicker(), 2)});
}

}  // namespace

void follow_frames(const FramesSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const Scene scene = read_gltf(settings.shared.scene, MaterialModel::glossy);
    const std::uint32_t thing = find_instance(scene, settings.thing);
    auto options = options_of<GlossyOptions>(settings.shared);
    std::vector<std::unique_ptr<Frame>> frames;
    std::optional<Atlas> atlas;
    for (int f = 0; f < settings.frames; ++f) {
        Scene posed = scene;
        posed.instances[thing].transform = turned(scene, thing, settings.degrees * f);
        frames.push_back(std::make_unique<Frame>(settings, std::move(posed), atlas,
                                                 SolverOptions{.method = options}, device));
        atlas = frames.front()->world.atlas;
    }
    report.say(fmt::format("{}, \"{}\" turns by {} degrees a frame, {} frames, {} lumels, {}",
                           settings.shared.scene, settings.thing, settings.degrees, settings.frames,
                           frames.front()->world.lumels.lumels.size(), words_of(device)));
    report.table("frames",
                 "Frame to frame coherence ([BSS05] section 6): of the map, against paths of each "
                 "frame, and how the error changes from frame to frame",
                 {"scheme", "iterations", "a frame begins", "RMSE %", "bias %", "flicker %",
                  "cpu s", "RMSE / from nothing", "flicker / from nothing"},
                 by_our_default(frames, device));
    for (const Scheme scheme : {Scheme::paper, Scheme::phased}) {
        options.scheme = scheme;
        options.views.batch = scheme == Scheme::paper ? 1 : GlossyOptions{}.views.batch;
        for (const int iterations : settings.iterations) {
            Errors from_nothing;
            for (const Manner& manner : kManners)
                play(frames, options, iterations, manner, device, from_nothing, report);
        }
    }
    device.check_validation();
}

}  // namespace lumel::bench
