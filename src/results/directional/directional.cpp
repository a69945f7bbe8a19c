// Directional light: spherical harmonics of the incoming radiance at every lumel.
//
// Not from the papers. The finished irradiance H of any method makes every lumel a source of
// radiosity B = E + ρH. Shooters are drawn from B and send it once more, as in stochastic.cpp, but
// receivers store its direction (directional.receive.comp). Close pairs are left out of the shots
// and taken from the near field (directional.near.comp). The fit of directional_fit.cpp converts
// directions to coefficients about each lumel's normal. Light of sky, sun and lamps is added by
// rays on the CPU (light_directions.cpp). Finally the coefficients are adjusted to give exactly H
// at that normal, so that noise of the shots only remains in the variation of irradiance with a
// tilted normal.

#include "results/directional/directional.h"

#include <algorithm>

#include "base/core/parallel.h"
#include "raster/eyes/eye_views.h"
#include "raster/near/near_rows.h"
#include "results/directional/directional.near.comp.h"
#include "results/directional/directional.receive.comp.h"
#include "results/directional/directional.shared.h"
#include "results/directional/light_directions.h"
#include "solve/shooting/lumel_arrays.h"
#include "solve/shooting/power_pyramid.h"
#include "solve/shooting/shooters.select.comp.h"
#include "solve/shooting/shooters.shared.h"

namespace lumel {
namespace {

/// Bounds on the number of shooters, and the minimum before a stop.
constexpr std::uint64_t kMinShots = 1024, kMaxShots = 4096, kShotsBeforeStop = 256;
/// Shooters if the solve had none.
constexpr std::uint64_t kUsualShots = 2048;

/// B = E + ρH [N]; 0 for buried lumels.
std::vector<glm::vec3> radiosity_of(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    std::vector<glm::vec3> radiosity = emission_of(lumels);
    for (std::size_t i = 0; i < radiosity.size(); ++i)
        if (!(lumels.lumels[i].flags & kLumelBuried))
            radiosity[i] += lumels.lumels[i].albedo * irradiance[i];
    return radiosity;
}

/// The GPU part.
class Gathering {
public:
    Gathering(const gpu::Device& device, const World& world, const Lumels& lumels,
              const NearField& near, const std::vector<glm::vec3>& radiosity,
              const DirectionalFit& fit, const DirectionalOptions& options)
        : options_(options),
          count_(std::uint32_t(lumels.lumels.size())),
          order_(std::uint32_t(fit.order())),
          batch_(std::clamp(options.batch, 1u, kMaxBatch)),
          near_radius_(near.radius),
          world_(&world),
          select_(device),
          receive_(device, std::uint32_t(options.projection)),
          near_(device),
          views_(device, world, options.projection, options.hemicube, batch_),
          eyes_(device, kMaxBatch),
          shots_(device, kMaxBatch),
          surface_(device, view(surfaces_of(lumels))),
          source_(device, view(radiosity)),
          fit_(device, view(fit.rows())),
          bands_{gpu::Array<glm::vec3>(device, count_), gpu::Array<glm::vec3>(device, 3 * count_),
                 gpu::Array<glm::vec3>(device, order_ < 2 ? 1 : 5 * count_)},
          near_rows_(device, near, count_),
          pyramid_(device, count_),
          pacer_(device)
    {
        batch_ = std::min(batch_, views_.capacity());
        pacer_.work("prepare", [&](gpu::Commands& commands) {
            for (const auto& band : bands_)
                commands.fill(band.buffer());
            pyramid_.build(commands, source_, surface_, kDefensiveShare, reflecting_area(lumels));
        });
    }

    /// Shoots one batch.
    void shoot()
    {
        select();
        views_.look_from(pacer_, eyes_, batch_);
        receive();
        sent_ += batch_;
        ++iteration_;
    }

    std::uint64_t sent() const { return sent_; }

    /// Ends the gathering: coefficients [4 or 9][N]. Waits for the device.
    std::vector<std::vector<glm::vec3>> finish()
    {
        pacer_.dispatch_parts("directional near", count_, kProbeLumels, near_,
                              {.lumels = world_->lumels(),
                               .pieces = world_->pieces(),
                               .fit = fit_,
                               .band0 = bands_[0],
                               .band1 = bands_[1],
                               .band2 = bands_[2],
                               .first = near_rows_.first(),
                               .column = near_rows_.column(),
                               .factor = near_rows_.factor(),
                               .source = source_},
                              {{}, count_, order_, float(sent_)});
        pacer_.finish();
        std::vector<std::vector<glm::vec3>> coefficients;
        for (std::uint32_t l = 0; l <= order_; ++l) {
            const std::vector<glm::vec3> band = bands_[l].download();
            for (auto m = band.begin(); m != band.end(); m += count_)
                coefficients.emplace_back(m, m + count_);
        }
        return coefficients;
    }

    const gpu::StageTimes& times() const { return pacer_.times(); }

private:
    void select()
    {
        const SelectParams params{.pyramid = pyramid_.layout(),
                                  .count = batch_,
                                  .emission_count = 0,
                                  .source_index = std::uint32_t(sent_),
                                  .seed = ~options_.seed,  // shooters differ from the solve's
                                  .disc = near_radius_ > 0.0f ? 0u : 1u,
                                  .centre = options_.rule == SampleRule::centre ? 1u : 0u,
                                  .channels = world_->has_coloured_glass() ? 1u : 0u};
        pacer_.dispatch("select", select_,
                        {.lumels = world_->lumels(),
                         .pieces = world_->pieces(),
                         .emission = source_,
                         .source = source_,
                         .emission_power = pyramid_.array(),
                         .source_power = pyramid_.array(),
                         .eyes = eyes_,
                         .shots = shots_},
                        params, batch_);
    }

    void receive()
    {
        DirectionalReceiveParams params{.views = views_.layout(),
                                        .count = count_,
                                        .shots = batch_,
                                        .iteration = iteration_,
                                        .seed = options_.seed,
                                        .centre = options_.rule == SampleRule::centre ? 1u : 0u,
                                        .order = order_,
                                        .near_radius = near_radius_};
        pacer_.dispatch_parts("directional receive", count_, kProbeLumels, receive_,
                              {.lumels = world_->lumels(),
                               .pieces = world_->pieces(),
                               .views = {views_.image(), views_.sampler()},
                               .eyes = eyes_,
                               .shots = shots_,
                               .fit = fit_,
                               .band0 = bands_[0],
                               .band1 = bands_[1],
                               .band2 = bands_[2]},
                              params);
    }

    DirectionalOptions options_;
    std::uint32_t count_;  ///< N lumels
    std::uint32_t order_;
    std::uint32_t batch_;  ///< K
    float near_radius_;
    const World* world_;
    gpu::Kernel<shaders::ShootersSelect> select_;
    gpu::Kernel<shaders::DirectionalReceive> receive_;
    gpu::Kernel<shaders::DirectionalNear> near_;
    EyeViews views_;
    gpu::Array<Eye> eyes_;
    gpu::Array<Shot> shots_;
    gpu::Array<glm::vec4> surface_;
    gpu::Array<glm::vec3> source_;  ///< B
    gpu::Array<FitRow> fit_;
    std::array<gpu::Array<glm::vec3>, kMaxBands> bands_;  ///< [2l + 1][N] sums
    NearRows near_rows_;
    PowerPyramid pyramid_;
    gpu::Pacer pacer_;  ///< last member: its destructor waits for work that uses others
    std::uint64_t sent_ = 0;
    std::uint32_t iteration_ = 0;
};

void settle_all(DirectionalLight& light, const DirectionalFit& fit,
                const std::vector<glm::vec3>& normals, const std::vector<glm::vec3>& irradiance)
{
    parallel_for(normals.size(), 1024, [&](std::size_t first, std::size_t last) {
        std::vector<glm::vec3> own(light.coefficients.size());
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t c = 0; c < own.size(); ++c)
                own[c] = light.coefficients[c][i];
            settle(fit, own, normals[i], irradiance[i]);
            for (std::size_t c = 0; c < own.size(); ++c)
                light.coefficients[c][i] = own[c];
        }
    });
}

}  // namespace

std::uint64_t directional_bytes(const SolveSize& size, const DirectionalOptions& options)
{
    if (options.kind == Directional::none)
        return 0;
    const std::size_t count = size.count();
    const auto coefficients = std::uint64_t(coefficient_count(int(options.kind)));
    return EyeViews::device_bytes(options.projection, options.hemicube, options.batch) +
           kMaxBatch * (sizeof(Eye) + sizeof(Shot)) +
           count * (sizeof(glm::vec4) + (1 + coefficients) * sizeof(glm::vec3)) +
           NearRows::device_bytes(count, size.near_pairs) + PowerPyramid::device_bytes(count);
}

std::uint64_t directional_shots(std::uint64_t solver_shots)
{
    return solver_shots > 0 ? std::clamp(solver_shots, kMinShots, kMaxShots) : kUsualShots;
}

std::vector<glm::vec3> world_normals(const Scene& scene, const Lumels& lumels)
{
    std::vector<glm::mat3> frames;  // by instance
    for (const Instance& instance : scene.instances)
        frames.push_back(glm::transpose(glm::inverse(glm::mat3(instance.transform))));
    std::vector<glm::vec3> normals;
    normals.reserve(lumels.lumels.size());
    for (const Lumel& lumel : lumels.lumels)
        normals.push_back(glm::normalize(frames[lumel.instance] * lumel.normal));
    return normals;
}

DirectionalLight gather_directional(const gpu::Device& device, const World& world,
                                    const Scene& scene, const RayScene& rays, const Lumels& lumels,
                                    const NearField& near, const std::vector<glm::vec3>& irradiance,
                                    const DirectionalOptions& options,
                                    const std::function<bool(double)>& go_on)
{
    const DirectionalFit fit(int(options.kind));
    // Lights first, for about this fraction of the time if there are any.
    const double share = has_far_lights(scene) ? 0.5 : 0.0;
    const std::vector<glm::vec3> normals = world_normals(scene, lumels);
    std::vector<std::vector<glm::vec3>> of_lights(
        std::size_t(coefficient_count(fit.order())),
        std::vector<glm::vec3>(lumels.lumels.size(), glm::vec3(0.0f)));
    if (share > 0.0)
        add_light_directions(scene, rays, lumels, normals, fit,
                             {.rule = options.rule, .seed = options.seed}, of_lights,
                             [&](double done) { return !go_on || go_on(share * done); });

    Gathering gathering(device, world, lumels, near, radiosity_of(lumels, irradiance), fit,
                        options);
    while (gathering.sent() < options.shots) {
        const double done = double(gathering.sent()) / double(options.shots);
        if (go_on && !go_on(share + (1.0 - share) * done) && gathering.sent() >= kShotsBeforeStop)
            break;
        gathering.shoot();
    }
    DirectionalLight light{gathering.finish(), gathering.sent(), gathering.times()};
    for (std::size_t c = 0; c < light.coefficients.size(); ++c)
        for (std::size_t i = 0; i < normals.size(); ++i)
            light.coefficients[c][i] += of_lights[c][i];
    settle_all(light, fit, normals, irradiance);
    return light;
}

}  // namespace lumel
