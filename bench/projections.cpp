// Hemispherical projection against hemicubes: who is wrong about what is seen, and what a view
// costs.

#include "bench/modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/core.h>

#include "bench/cut.h"
#include "bench/stopwatch.h"
#include "raster/eyes/probe.h"

namespace lumel::bench {
namespace {

constexpr std::uint32_t kEyes = 64;
constexpr int kRounds = 5;         ///< of drawing; the fastest counts
constexpr float kGrazing = 1e-3f;  ///< least cosine at both ends of a pair
constexpr float kOffset = 1e-4f;   ///< by which rays are shortened at both ends [m]
constexpr std::uint32_t kSeed = 1;

/// Eyes and points to test, both on the scene's lumels.
struct Pairs {
    std::vector<Eye> eyes;
    std::vector<Lumel> lumels;            ///< in the world
    std::vector<std::vector<char>> seen;  ///< [eye][lumel], by rays; only of pairs that face
};

bool face(const Eye& eye, const Lumel& lumel)
{
    const glm::vec3 direction = glm::normalize(lumel.position - eye.position);
    return glm::dot(direction, eye.normal) > kGrazing &&
           glm::dot(direction, lumel.normal) < -kGrazing;
}

/// Form factor from the eye's point to the lumel, were it seen.
double form_factor(const Eye& eye, const Lumel& lumel)
{
    const glm::vec3 d = lumel.position - eye.position;
    const double r2 = double(glm::dot(d, d));
    return double(glm::dot(d, eye.normal)) * -double(glm::dot(d, lumel.normal)) *
           double(lumel.area) / (std::numbers::pi * r2 * r2 + r2 * double(lumel.area));
}

Pairs draw_pairs(const gpu::Device& device, const SolveScene& world)
{
    Pairs pairs;
    for (const Lumel& lumel : World(device, world.scene, world.lumels).lumels().download())
        if (!(lumel.flags & kLumelBuried))
            pairs.lumels.push_back(lumel);
    std::mt19937 random(kSeed);
    for (std::uint32_t i = 0; i < kEyes; ++i) {
        const Lumel& lumel = pairs.lumels[random() % pairs.lumels.size()];
        pairs.eyes.push_back(eye_at(lumel.position, lumel.normal));
    }
    for (const Eye& eye : pairs.eyes) {
        std::vector<char>& row = pairs.seen.emplace_back();
        for (const Lumel& lumel : pairs.lumels)
            row.push_back(face(eye, lumel) &&
                          world.rays.sees(eye.position, lumel.position, kOffset, kSeed));
    }
    return pairs;
}

/// Shares that disagree with rays.
struct Disagreement {
    double of_pairs = 0.0;
    double of_light = 0.0;  ///< form factors of disagreeing pairs, over those of all that are seen
};

Disagreement compare(const Pairs& pairs, const std::vector<std::vector<std::uint32_t>>& answers)
{
    double tested = 0.0, wrong = 0.0, seen_light = 0.0, wrong_light = 0.0;
    for (std::size_t e = 0; e < pairs.eyes.size(); ++e)
        for (std::size_t i = 0; i < pairs.lumels.size(); ++i) {
            if (!face(pairs.eyes[e], pairs.lumels[i]))
                continue;
            const bool truth = pairs.seen[e][i] != 0, answer = answers[e][i] != 0;
            const double light = form_factor(pairs.eyes[e], pairs.lumels[i]);
            tested += 1.0;
            wrong += truth != answer;
            seen_light += truth ? light : 0.0;
            wrong_light += truth != answer ? light : 0.0;
        }
    return {wrong / tested, wrong_light / seen_light};
}

/// Pieces of an edge between two directions, as hemisphere.cut.comp counts them.
double pieces_of(const glm::vec3& a, const glm::vec3& b, float chord)
{
    constexpr double most = 64.0;
    const float angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    return std::clamp(std::exp2(std::ceil(std::log2(double(angle / chord)))), 1.0, most);
}

/// Triangles that hemispheres of that side draw for each eye, on average, if all are cut into
/// strips: two less than their edges have pieces.
double drawn_in_hemispheres(const World& world, const std::vector<Eye>& eyes, std::uint32_t side)
{
    const std::vector<glm::vec3> vertices = world.vertices().download();
    const std::vector<std::uint32_t> indices = world.indices().download();
    const gpu::Range range = world.drawn(world.opaque());
    const float chord = longest_chord(0.5f * float(side));
    double count = 0.0;
    for (const Eye& eye : eyes)
        for (std::size_t k = range.first; k < range.first + range.count; k += 3) {
            const glm::vec3 a = vertices[indices[k]] - eye.position,
                            b = vertices[indices[k + 1]] - eye.position,
                            c = vertices[indices[k + 2]] - eye.position;
            if (std::max({glm::dot(a, eye.normal), glm::dot(b, eye.normal),
                          glm::dot(c, eye.normal)}) > 0.0f)
                count +=
                    pieces_of(b, c, chord) + pieces_of(c, a, chord) + pieces_of(a, b, chord) - 2.0;
        }
    return count / double(eyes.size());
}

struct View {
    Disagreement wrong;
    double drawn = 0.0;         ///< triangles per eye
    double milliseconds = 0.0;  ///< of device time per eye
    double cpu_milliseconds = 0.0;
};

View look(const gpu::Device& device, const World& world, Projection projection, const Pairs& pairs,
          const Settings& settings)
{
    EyeViews views(device, world, projection,
                   std::uint32_t(views_of(settings.given.options()).hemicube), kEyes);
    if (views.capacity() < kEyes)
        throw Error(ErrorKind::input, "--hemicube", "is too large for the views of all eyes");
    const gpu::Array<Eye> eyes(device, std::span<const Eye>(pairs.eyes));
    std::vector<Question> questions;
    for (const Lumel& lumel : pairs.lumels)
        questions.push_back({lumel.position, lumel.normal});
    View view{.milliseconds = 1e30, .cpu_milliseconds = 1e30};
    gpu::Commands commands(device);
    for (int round = 0; round < kRounds; ++round) {
        Stopwatch watch;
        watch.start();
        views.look_from(commands, eyes, kEyes);
        commands.run();
        watch.stop();
        view.milliseconds = std::min(view.milliseconds, commands.last_milliseconds() / kEyes);
        view.cpu_milliseconds = std::min(view.cpu_milliseconds, 1e3 * watch.cpu / kEyes);
    }
    view.wrong =
        compare(pairs, ask(device, views, eyes,
                           gpu::Array<Question>(device, std::span<const Question>(questions))));
    view.drawn = projection == Projection::hemicube
                     ? double(kHemicubeFaces) * double(world.indices().size()) / 3.0
                     : drawn_in_hemispheres(world, pairs.eyes, views.layout().side);
    return view;
}

}  // namespace

void compare_projections(const Settings& settings)
{
    const gpu::Device device(settings.device);
    const SolveScene world = prepare(settings, settings.size);
    const Pairs pairs = draw_pairs(device, world);
    fmt::print("{}: {} lumels, {} eyes, device: {} ({})\n", settings.scene, pairs.lumels.size(),
               kEyes, device.info().name, device.info().driver);
    fmt::print("{:>9} {:>11} {:>9} {:>14} {:>14} {:>8} {:>8}\n", "triangles", "projection", "drawn",
               "pairs wrong %", "light wrong %", "ms", "cpu ms");
    for (const int pieces : settings.cuts) {
        const Scene scene = cut(world.scene, pieces);
        const World cut_world(device, scene, world.lumels);
        for (const Projection projection : {Projection::hemicube, Projection::hemisphere}) {
            const View view = look(device, cut_world, projection, pairs, settings);
            fmt::print("{:>9} {:>11} {:>9.0f} {:>14.2f} {:>14.2f} {:>8.2f} {:>8.2f}\n",
                       cut_world.indices().size() / 3,
                       projection == Projection::hemicube ? "hemicube" : "hemisphere", view.drawn,
                       100.0 * view.wrong.of_pairs, 100.0 * view.wrong.of_light, view.milliseconds,
                       view.cpu_milliseconds);
            std::fflush(stdout);
        }
    }
    device.check_validation();
}

}  // namespace lumel::bench
