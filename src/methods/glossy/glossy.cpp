// Stochastic glossy global illumination.
//
//   [BSS05] A. Barsi, L. Szirmay-Kalos, G. Szijártó. Stochastic Glossy Global Illumination on the
//           GPU. 2005.
//   [VG95]  E. Veach, L. Guibas. Optimally Combining Sampling Techniques. 1995.
//   [NNS99] The reflectance model; see phong.h.
//
// A lumel stores no directional light, only the actual irradiance of the last iteration and, common
// to all lumels, the positions of the shooters that caused it:
//
//     repeat
//         draw shooters y_k on lumels j_k with p_j ∝ 𝓛(E_j + Σ I_j a_j(ω_j)) A_j      select
//         see the world from y_k                                                      look_from
//         for all lumels i:                                                           receive
//             I_i ← L_j(ω) V cosθ_i cosθ_j / r² · A_j / p_j         Eq. (2), (4)
//             H_i ← running average of I_i
//             C ← running average of what they reflect to the eye       Eq. (6), eye_image
//
// where L_j(ω) = E_j/π + Σ I_j f_r(ω_j, ω), Eq. (5), with the I_j of the iteration before.
//
// `Scheme::paper` with K = 1 is the paper's iteration: all iterations are averaged, and merged
// texels shoot from their common centre. Two additions: receiving points move over lumels, except
// with SampleRule::centre, and shooters are drawn by power or by area, weighted. The paper names
// multiple importance sampling (figure 1), but not its techniques.
//
// Other differences from the paper:
// - K shooters per iteration.
// - Given LobeParticles, these carry the light of lobes, and shooters send E + ρ_d I alone.
//   Without them, some of a shooter's K lobes represent all, drawn by reflected light: one where
//   they are wide, K but at most 64 where they are narrow.
// - Shooters come from an Owen-scrambled Sobol sequence, and their points spread over the lumel
//   (not with Scheme::paper).
// - Pairs of close lumels exchange their diffuse light exactly (the near field), and reflect it
//   diffusely; lobes between them use the same form factors. With Scheme::paper all pairs have the
//   disc term of Eq. (8) instead.
// - With particles the iteration is in phases (glossy_phases.cpp). Without, the average forgets the
//   first iterations, in which light had not yet spread (not with Scheme::paper).
// - Frames with a new eye or changed light draw by mean power, from a common start; those of a
//   moved scene continue from the mean light of the previous frame (glossy_frames.cpp).

#include "methods/glossy/glossy.h"

#include <algorithm>
#include <cmath>

#include "methods/glossy/phong.h"
#include "rays/paths/samples.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Iterations after which the average restarts: earlier ones lack bounces.
constexpr std::uint64_t kRestarts[] = {8, 32};
/// Iterations after the last restart before the error is estimated.
constexpr std::uint64_t kFirstStated = 2;
/// Shooters per particle and lumel: both then take about as long.
constexpr std::size_t kShootersPerParticle = 8;
/// Fraction of the paper's shooters drawn by area alone. Half of them, or drawing by emission, more
/// than doubles the variance: with p in proportion to power all shooters send the same.
constexpr float kAreaShare = 0.1f;

}  // namespace

GlossyIllumination::Kernels::Kernels(const gpu::Device& device, Projection projection)
    : select(device),
      receive(device, std::uint32_t(projection)),
      evaluate(device)
{
}

GlossyIllumination::GlossyIllumination(const gpu::Device& device, const World& world,
                                       const Lumels& lumels, const NearField& near,
                                       const GlossyOptions& options,
                                       std::span<const glm::vec3> known,
                                       const LobeParticles* particles,
                                       std::span<const glm::vec3> first_emission)
    : options_(options),
      count_(std::uint32_t(lumels.lumels.size())),
      batch_(std::uint32_t(options.views.batch)),
      paper_(options.scheme == Scheme::paper),
      atlas_width_(std::uint32_t(lumels.width)),
      near_radius_(paper_ ? 0.0f : near.radius),
      reflecting_area_(reflecting_area(lumels)),
      emitted_power_(emitted_power(lumels, emission_of(lumels))),
      known_sum_(first_emission.empty() ? irradiance_sum(known) : 0.0),
      device_(&device),
      world_(&world),
      lumels_(&lumels),
      particles_(!paper_ && particles && particles->any() ? particles : nullptr),
      kernels_(device, options.views.projection),
      eyes_{{device, kMaxGlossyBatch}, {device, kMaxGlossyBatch}},
      shots_(device, kMaxGlossyBatch),
      lobes_(device, kMaxGlossyBatch * kMaxLobes),
      surface_(device, view(surfaces_of(lumels))),
      gloss_(device, view(lumels.gloss)),
      albedo_table_(device, view(phong_albedo_table())),
      emission_(device, view(emission_of(lumels))),
      exitance_(device, count_),
      diffuse_(device, count_),
      near_(device, count_),
      last_(device, particles_ ? 1 : std::size_t(batch_) * count_),
      carried_(device, particles_, known, first_emission, count_),
      sums_(device, 2 * count_),
      absorbed_(device, 2 * count_),
      irradiance_(device, count_),
      figures_(device, count_),
      near_rows_(device, near, count_),
      power_(device, count_),
      area_power_(device, count_),
      pacer_(device)
{
    begin();
    if (particles_) {
        begin_phases(near, known, first_emission);
        return;
    }
    views_.emplace(device, world, options.views.projection, std::uint32_t(options.views.hemicube),
                   batch_);
    batch_ = std::min(batch_, views_->capacity());
}

void GlossyIllumination::begin()
{
    pacer_.work("prepare", [&](gpu::Commands& commands) {
        for (const auto* array : {&near_, &last_, &sums_, &absorbed_, &irradiance_})
            commands.fill(array->buffer());
        commands.copy(emission_.buffer(), exitance_.buffer(), count_ * sizeof(glm::vec3));
        commands.copy(emission_.buffer(), diffuse_.buffer(), count_ * sizeof(glm::vec3));
        power_.build(commands, exitance_, surface_, 0.0f, 0.0f);
        area_power_.build(commands, emission_, surface_, 1.0f, reflecting_area_);
    });
}

std::uint64_t GlossyIllumination::device_bytes(const SolveSize& size, const GlossyOptions& options)
{
    constexpr std::uint64_t kVectors = 5, kHalves = 2;  // arrays of vec3 [N] and [2][N]
    const std::size_t count = size.count();
    const auto batch = std::uint32_t(options.views.batch);
    // Without particles the last irradiance from every shooter is stored.
    const std::uint64_t last = options.scheme == Scheme::paper ? std::uint64_t(batch) * count : 1;
    return EyeViews::device_bytes(options.views.projection, std::uint32_t(options.views.hemicube),
                                  batch) +
           kMaxGlossyBatch *
               (2 * sizeof(Eye) + sizeof(GlossyShot) + kMaxLobes * sizeof(GlossyLobe)) +
           count *
               (sizeof(glm::vec4) + sizeof(Gloss) + (kVectors + 2 * kHalves) * sizeof(glm::vec3)) +
           last * sizeof(glm::vec3) + phong_albedo_table().size() * sizeof(float) +
           LumelSums::device_bytes(count) + NearRows::device_bytes(count, size.near_pairs) +
           2 * PowerPyramid::device_bytes(count) + CarriedLight::device_bytes(count) +
           (options.scheme == Scheme::paper
                ? 0
                : PhaseParticles::device_bytes(count) +
                      StochasticRadiosity::device_bytes(size, {.views = options.views}));
}

void GlossyIllumination::step()
{
    if (phases_) {
        phases_->step();
        state_ = phases_->state();
        averaged_ = state_.iterations;
        return;
    }
    take_figures();
    if (!paper_ && !goes_on_ &&
        std::find(std::begin(kRestarts), std::end(kRestarts), state_.iterations) !=
            std::end(kRestarts))
        restart();
    select();
    carry();
    views_->look_from(pacer_, eyes_[state_.iterations % 2], batch_);
    receive();
    if (eye_)
        eye_->receive(pacer_, *views_, eyes_[state_.iterations % 2], shots_, lobes_, batch_);
    has_before_ = true;
    ++batches_[iteration_++ % 2];
    ++averaged_;
    ++state_.iterations;
    state_.shots += batch_;
    next_shot_ += batch_;
    if (std::min(batches_[0], batches_[1]) >= 1.0f)
        figures_.request(pacer_, state_.iterations,
                         [&](gpu::Commands& commands) { evaluate(commands); });
}

void GlossyIllumination::restart()
{
    pacer_.work("restart", [&](gpu::Commands& commands) {
        commands.fill(sums_.buffer());
        commands.fill(absorbed_.buffer());
    });
    batches_ = {};
    averaged_ = 0;
    state_.error = -1.0;
}

bool GlossyIllumination::has_two_choices() const
{
    return paper_ && options_.two_choices && emitted_power_ > 0.0 && reflecting_area_ > 0.0f;
}

/// kAreaShare of the batch on average; its fraction is rounded up by chance.
std::uint32_t GlossyIllumination::area_shots() const
{
    if (!has_two_choices())
        return 0;
    const float coin = PathSamples(PathSamples::hash(options_.seed, next_shot_), 0).random(0).x;
    return std::uint32_t(kAreaShare * float(batch_) + coin);
}

void GlossyIllumination::select()
{
    const std::size_t now = state_.iterations % 2;
    const GlossySelectParams params{.pyramid = power_.layout(),
                                    .count = count_,
                                    .shots = batch_,
                                    .before = has_before_ && !particles_ ? batch_ : 0u,
                                    .index = next_shot_,
                                    .seed = options_.seed,
                                    .random = paper_ ? 1u : 0u,
                                    .channels = world_->has_coloured_glass() ? 1u : 0u,
                                    .centre = paper_ ? 1u : 0u,
                                    .merge = paper_ ? options_.merge : 0u,
                                    .width = atlas_width_,
                                    .area_shots = area_shots(),
                                    .area_share = has_two_choices() ? kAreaShare : 0.0f};
    pacer_.dispatch("select", kernels_.select,
                    {.lumels = world_->lumels(),
                     .pieces = world_->pieces(),
                     .albedo_table = albedo_table_,
                     .gloss = gloss_,
                     .diffuse = diffuse_,
                     .last = last_,
                     .power = power_.array(),
                     .area_power = area_power_.array(),
                     .before = eyes_[1 - now],
                     .eyes = eyes_[now],
                     .shots = shots_,
                     .lobes_sent = lobes_},
                    params, batch_);
}

void GlossyIllumination::carry()
{
    const std::size_t particles = std::size_t(batch_) * count_ / kShootersPerParticle + 1;
    carried_.begin(pacer_, diffuse_, particles, options_.seed, iteration_);
}

void GlossyIllumination::receive()
{
    const auto& eyes = eyes_[state_.iterations % 2];
    if (!paper_)
        pacer_.work("near",
                    [&](gpu::Commands& commands) { near_rows_.light(commands, diffuse_, near_); });
    GlossyReceiveParams params{.views = views_->layout(),
                               .count = count_,
                               .shots = batch_,
                               .half_index = iteration_ % 2,
                               .iteration = iteration_,
                               .seed = options_.seed,
                               .centre = options_.rule == SampleRule::centre ? 1u : 0u,
                               .near_radius = near_radius_,
                               .particles = particles_ ? 1u : 0u};
    pacer_.dispatch_parts("receive", count_, kProbeLumels, kernels_.receive,
                          {.lumels = world_->lumels(),
                           .pieces = world_->pieces(),
                           .albedo_table = albedo_table_,
                           .lobes_sent = lobes_,
                           .views = {views_->image(), views_->sampler()},
                           .near_first = near_rows_.first(),
                           .near_column = near_rows_.column(),
                           .near_factors = near_rows_.factor(),
                           .eyes = eyes,
                           .shots = shots_,
                           .gloss = gloss_,
                           .emission = emission_,
                           .near = near_,
                           .last = last_,
                           .sums = sums_,
                           .exitance = exitance_,
                           .absorbed = absorbed_,
                           .diffuse_exitance = diffuse_,
                           .carried = carried_.irradiance(),
                           .passed_on = carried_.reflected()},
                          params);
    carried_.end(pacer_, diffuse_);
    if (!held_)
        draw_in_proportion_to(exitance_, 0.0f);
}

void GlossyIllumination::evaluate(gpu::Commands& commands)
{
    commands.dispatch(kernels_.evaluate,
                      {.surface = surface_,
                       .sums = sums_,
                       .absorbed = absorbed_,
                       .irradiance = irradiance_,
                       .parts = figures_.parts()},
                      GlossyEvaluateParams{count_, {batches_[0], batches_[1]}}, count_);
    figures_.add_up(commands);
}

void GlossyIllumination::take_figures()
{
    const std::optional<Terms> terms = figures_.poll(pacer_, state_.iterations);
    if (!terms)
        return;
    const glm::vec4 sums = terms->column[0];
    const double count = 3.0 * double(sums.z);
    const std::uint64_t error_estimate = goes_on_ ? 0 : *std::rbegin(kRestarts);
    const bool settled = state_.iterations > error_estimate + kFirstStated;
    if (!(sums.y > 0.0f) || count <= 0.0)
        state_.error = emitted_power_ > 0.0 && !settled ? -1.0 : 0.0;
    else if (settled)
        state_.error = std::sqrt(double(sums.x) / count) / ((double(sums.y) + known_sum_) / count);
}

std::vector<glm::vec3> GlossyIllumination::irradiance()
{
    if (phases_)
        return mean_of_phases();
    pacer_.work("evaluate", [&](gpu::Commands& commands) { evaluate(commands); });
    pacer_.finish();
    return irradiance_.download();
}

void GlossyIllumination::draw_in_proportion_to(const gpu::Array<glm::vec3>& exitance, float by_area)
{
    pacer_.work("power", [&](gpu::Commands& commands) {
        power_.build(commands, exitance, surface_, by_area, reflecting_area_);
    });
}

std::vector<glm::vec3> GlossyIllumination::eye_radiance()
{
    pacer_.finish();
    return eye_ ? eye_->radiance() : std::vector<glm::vec3>();
}

}  // namespace lumel
