// [BSS05] section 5 and figure 1: "partial analytic integration and multiple importance sampling",
// each measured with and without.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/our_default.h"
#include "bench/papers/spread.h"
#include "bench/stopwatch.h"
#include "jobs/solve/setting.h"
#include "methods/glossy/glossy.h"
#include "methods/stochastic/stochastic.h"
#include "results/picture/lobe_rays.h"
#include "results/picture/seen.h"
#include "results/preview/view.h"
#include "solve/shooting/lumel_arrays.h"
#include "solve/solver/solver.h"

namespace lumel::bench {
namespace {

/// Places looked at within a pixel.
constexpr std::uint32_t kSets = 4;

/// A technique that finds what lobes reflect to the eye, and its result.
struct Technique {
    const char* name;
    std::uint64_t shots;
    std::uint32_t rays;
    Spread spread;
    double cpu = 0.0;  ///< of all runs [s]
};

/// A glossy scene and what its camera sees.
struct Sight {
    Sight(const AblationSettings& settings, const gpu::Device& device);

    SolverOptions options;  ///< of GlossyOptions
    SolveScene world;
    NearField near;
    World resident;
    std::optional<LobeParticles> particles;
    WorldLumels standing;
    Seen seen;
    std::vector<char> counts;  ///< [pixels] 1: shows gloss and no lamp
};

Settings glossy(Settings settings)
{
    settings.given.id = "glossy";
    return settings;
}

Seen seen_by_camera(const AblationSettings& settings, const SolveScene& world)
{
    const View view = choose_view(world.scene, world.rays);
    const int height = std::max(1, int(std::lround(float(settings.width) / view.aspect)));
    return look(view, settings.width, height, kSets, world.rays, world.surfaces, {});
}

Sight::Sight(const AblationSettings& settings, const gpu::Device& device)
    : options(solver_of(glossy(settings.shared))),
      world(read_gltf(settings.shared.scene, MaterialModel::glossy),
            AtlasOptions{.size = settings.shared.size}),
      near(build_near_field(world.scene, world.rays, world.lumels, near_field_options(options))),
      resident(device, world.scene, world.lumels),
      particles(particles_for(world, options)),
      standing(world.scene, world.rays, world.lumels),
      seen(seen_by_camera(settings, world)),
      counts(std::size_t(seen.width) * std::size_t(seen.height), 0)
{
    for (const std::uint32_t point : seen.index)
        counts[point % counts.size()] = 1;
    for (std::size_t i = 0; i < seen.points.size(); ++i)
        if (luminance(seen.points[i].luminance) > 0.0)
            counts[i % counts.size()] = 0;
}

/// What the lobes add to each pixel that counts [cd/m²].
std::vector<double> pixels_of(const Sight& sight, const std::vector<glm::vec3>& reflected)
{
    std::vector<double> all(sight.counts.size(), 0.0), kept;
    for (std::size_t g = 0; g < reflected.size(); ++g)
        all[sight.seen.index[g] % all.size()] += luminance(reflected[g]) / kSets;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (sight.counts[i])
            kept.push_back(all[i]);
    return kept;
}

/// One picture, made as lumel render does.
void take(Technique& technique, const Sight& sight, GlossyIllumination& solver, const LitScene& lit,
          std::uint32_t seed)
{
    Stopwatch watch;
    watch.start();
    const EyeSampling sampling{sight.seen.first, technique.shots, technique.rays};
    const std::vector<float> brightness = solver.brightness();
    std::vector<glm::vec3> radiance(sight.seen.glossy.size());
    if (technique.shots > 0) {
        solver.look_at(sight.seen.glossy, brightness, sampling);
        const std::uint64_t end = solver.state().shots + technique.shots;
        while (solver.state().shots < end)
            solver.step();
        radiance = solver.eye_radiance();
    }
    const LobeRayOptions lobes{.rays = technique.rays,
                               .shooters = technique.shots > 0 ? sampling.shooters() : 0.0f,
                               .seed = seed};
    const PowerDraw senders(sight.standing, sight.world.lumels, brightness);
    const std::vector<glm::vec3> along = gather_along_lobes(sight.seen.glossy, lit, senders, lobes);
    for (std::size_t g = 0; g < radiance.size(); ++g)
        radiance[g] += along[g];
    watch.stop();
    technique.cpu += watch.cpu;
    technique.spread.add(pixels_of(sight, radiance));
}

void add_techniques(Report& report, const std::vector<Technique>& techniques, const Sight& sight,
                    int seeds)
{
    report.table("weighting",
                 fmt::format("Multiple importance sampling ([BSS05] figure 1): {} × {} pixels, {} "
                             "seeds",
                             sight.seen.width, sight.seen.height, seeds),
                 {"method", "shooters", "rays", "mean cd/m²", "variance / mean²", "cpu s",
                  "product", "product / that of rays alone"},
                 "rays alone");
    const auto product = [](const Technique& technique) {
        return technique.spread.variance() * technique.cpu;
    };
    for (const Technique& technique : techniques) {
        const double cpu = technique.cpu / seeds;
        report.row({technique.name, technique.shots, technique.rays,
                    significant(technique.spread.mean(), 4),
                    significant(technique.spread.variance(), 3), fixed(cpu, 3),
                    significant(technique.spread.variance() * cpu, 3),
                    significant(product(technique) / product(techniques[1]), 3)});
    }
}

/// Shooters, rays, and both. Only what the lobes reflect is counted: the rest is the same in all.
void ablate_weighing(const AblationSettings& settings, const gpu::Device& device, Report& report)
{
    const Sight sight(settings, device);
    const auto shots = std::uint64_t(settings.eye_shots);
    const auto rays = std::uint32_t(settings.rays);
    std::vector<Technique> techniques = {{.name = "shooters alone", .shots = shots, .rays = 0},
                                         {.name = "rays alone", .shots = 0, .rays = rays},
                                         {.name = "both, weighted", .shots = shots, .rays = rays}};
    for (int i = 0; i < settings.seeds; ++i) {
        SolverOptions options = sight.options;
        auto& gloss = std::get<GlossyOptions>(options.method);
        gloss.seed += std::uint32_t(i);
        options.max_shots = std::uint64_t(settings.solving_shots);
        options.target_error = 0.0;
        GlossyIllumination solver(device, sight.resident, sight.world.lumels, sight.near, gloss, {},
                                  &*sight.particles);
        solve(solver, options);
        // Without rays, shooters send what lobes do.
        GlossyIllumination alone(device, sight.resident, sight.world.lumels, sight.near, gloss);
        solve(alone, options);
        const SolveScene& world = sight.world;
        const SideMaps maps =
            finish_sides(world.scene, world.atlas, world.lumels, solver.irradiance());
        const LitScene lit(world, maps.front, maps.back);
        if (i == 0) {  // the driver compiles shaders when they first run
            Technique warm = techniques.back();
            take(warm, sight, solver, lit, gloss.seed);
        }
        for (Technique& technique : techniques)
            take(technique, sight, technique.rays > 0 ? solver : alone, lit, gloss.seed);
    }
    add_techniques(report, techniques, sight, settings.seeds);
}

/// Light at every lumel after some iterations of the papers' scheme, between seeds.
Spread spread_of_irradiance(const AblationSettings& settings, const gpu::Device& device,
                            const SolveScene& world, const World& resident,
                            const StochasticOptions& options)
{
    Spread spread;
    for (int i = 0; i < settings.seeds; ++i) {
        StochasticOptions seeded = options;
        seeded.seed += std::uint32_t(i);
        StochasticRadiosity solver(device, resident, world.lumels, no_near_field(world.lumels),
                                   seeded);
        for (int k = 0; k < settings.iterations; ++k)
            solver.step();
        std::vector<double> values;
        for (const glm::vec3& irradiance : solver.irradiance())
            values.push_back(luminance(irradiance));
        spread.add(values);
    }
    return spread;
}

/// [BSS05] section 5 and figure 1 as the papers' glossy scheme has them: light at every lumel,
/// between seeds.
void ablate_choices(const AblationSettings& settings, const gpu::Device& device, Report& report)
{
    const Settings shared = glossy(settings.shared);
    const SolveScene world(read_gltf(shared.scene, MaterialModel::glossy),
                           AtlasOptions{.size = shared.size});
    const World resident(device, world.scene, world.lumels);
    report.table(
        "choices",
        fmt::format("Merged shooters and two choices of shooter, the papers' glossy scheme: "
                    "{} lumels, {} iterations, {} seeds",
                    world.lumels.lumels.size(), settings.iterations, settings.seeds),
        {"shooters", "drawn by", "mean lx", "variance / mean²", "cpu s", "product",
         "product / that by power"},
        "other schemes");
    for (const std::uint32_t merge : {0u, 1u}) {
        double by_power = 0.0;
        for (const bool two_choices : {false, true}) {
            Spread spread;
            Stopwatch watch;
            for (int i = 0; i < settings.seeds; ++i) {
                auto options = options_of<GlossyOptions>(shared);
                options.seed += std::uint32_t(i);
                options.views.batch = 1;
                options.scheme = Scheme::paper;
                options.rule = SampleRule::centre;
                options.merge = merge;
                options.two_choices = two_choices;
                GlossyIllumination solver(device, resident, world.lumels,
                                          no_near_field(world.lumels), options);
                watch.start();
                for (int k = 0; k < settings.iterations; ++k)
                    solver.step();
                std::vector<double> values;
                for (const glm::vec3& irradiance : solver.irradiance())
                    values.push_back(luminance(irradiance));
                watch.stop();
                spread.add(values);
            }
            const double cpu = watch.cpu / settings.seeds, product = spread.variance() * cpu;
            if (!two_choices)
                by_power = product;
            report.row({merge > 0 ? "2 × 2 texels" : "texels",
                        two_choices ? "power or area, weighted" : "power",
                        significant(spread.mean(), 4), significant(spread.variance(), 3),
                        fixed(cpu, 3), significant(product, 3),
                        significant(product / by_power, 3)});
        }
    }
}

/// Variance between seeds, and processor time of one.
Cell by_our_default(const AblationSettings& settings, const gpu::Device& device,
                    const SolveScene& world)
{
    Spread spread;
    double cpu = 0.0;
    for (int i = 0; i < settings.seeds; ++i) {
        SolverOptions options;
        set_default_limits(options);
        std::get<LinksOptions>(options.method).seed += std::uint32_t(i);
        const Solved ours = solve_by(device, world, options);
        std::vector<double> values;
        for (const glm::vec3& irradiance : ours.irradiance)
            values.push_back(luminance(irradiance));
        spread.add(values);
        cpu += ours.cpu / settings.seeds;
    }
    return {fmt::format("{:.2g}, {:.2f} s", spread.variance(), cpu), spread.variance()};
}

struct Partial {
    const char* below;
    bool disc;
    std::uint32_t merge;
};

/// Eq. (8): with r² + A/π below, and with r² alone; A of a texel, and of merged ones.
void ablate_disc(const AblationSettings& settings, const gpu::Device& device, Report& report)
{
    Settings diffuse = settings.shared;
    diffuse.given.id = "stochastic";
    const SolveScene world = prepare(diffuse, diffuse.size);
    const World resident(device, world.scene, world.lumels);
    report.table("disc",
                 fmt::format("Partial analytic integration ([BSS05] Eq. (8)): {} lumels, {} "
                             "iterations, {} seeds",
                             world.lumels.lumels.size(), settings.iterations, settings.seeds),
                 {"points", "below", "mean lx", "variance / mean²", "largest deviation / mean",
                  "variance / that of r²"},
                 by_our_default(settings, device, world));
    for (const SampleRule rule : {SampleRule::centre, SampleRule::area}) {
        double plain = 0.0;  // variance with r² alone
        for (const Partial& partial : {Partial{"r²", false, 0}, Partial{"r² + A/π", true, 0},
                                       Partial{"r² + A/π, 2 × 2 texels merged", true, 1},
                                       Partial{"r² + A/π, 4 × 4 texels merged", true, 2}}) {
            auto options = options_of<StochasticOptions>(diffuse);
            options.views.batch = 1;
            options.iteration.scheme = Scheme::paper;
            options.rule = rule;
            options.disc = partial.disc;
            options.merge = partial.merge;
            const Spread spread = spread_of_irradiance(settings, device, world, resident, options);
            if (!partial.disc)
                plain = spread.variance();
            report.row({rule == SampleRule::centre ? "centres" : "spread over lumels",
                        partial.below, significant(spread.mean(), 4),
                        significant(spread.variance(), 4), significant(spread.largest(), 4),
                        significant(spread.variance() / plain, 3)});
        }
    }
}

}  // namespace

void ablate(const AblationSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    report.say(fmt::format("{}, {}", settings.shared.scene, words_of(device)));
    ablate_weighing(settings, device, report);
    ablate_choices(settings, device, report);
    ablate_disc(settings, device, report);
    device.check_validation();
}

}  // namespace lumel::bench
