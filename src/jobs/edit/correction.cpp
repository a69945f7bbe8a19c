// With T and T' the transport operators before and now, H = D + T (E + ρH) as baked, D the light of
// sky and lamps, and primes for the edited scene, H' = D' + T' (E' + ρ'H') is computed as
//
//     H~ = H + D' - D          initial estimate; for new or moved lumels, gathered with few rays
//     B° = E + ρH              radiosity: E' + ρ'H~ if the lumel differs from before
//     R  = (T' - T) B°         change by moved objects             (jobs/edit/changed_light)
//     X  = T' (B~ - B° + ρ'(R + X)),   B~ = E' + ρ'H~              (jobs/edit/signed_light)
//     H' = H~ + R + X.
//
// The error of the bake stays; the noise of R and X is in proportion to the change.

#include "jobs/edit/correction.h"

#include <algorithm>
#include <cmath>

#include "atlas/near/world_lumels.h"
#include "base/core/luminance.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Rays of the initial estimate of new or moved lumels.
constexpr std::uint32_t kFirstLook = 64;
/// Lumels with too much noise are gathered again with kMoreEffort × as many rays, up to kMaxEffort
/// ×.
constexpr std::uint32_t kMoreEffort = 4, kMaxEffort = 64;
/// Limit on the rays per lumel of the scene, on average; the residual then stays larger.
constexpr std::uint64_t kMaxRays = 1024;
/// With more particles per lumel, and more than kFewParticles in total, a new solution is faster.
constexpr std::uint64_t kMaxParticles = 256, kFewParticles = 1 << 21;

/// Mean over open lumels and channels, to which errors are relative [lx].
double mean_light(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        if (!is_buried(lumels.lumels[i])) {
            sum += double(irradiance[i].r) + double(irradiance[i].g) + double(irradiance[i].b);
            count += 3.0;
        }
    return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

Correction::Correction(const EditedScene& edit, const StoredSolution& solution,
                       const BakeRecord& baked, CorrectionWatch watch)
    : edit_(edit),
      baked_(baked),
      watch_(std::move(watch)),
      hits_before_(edit.before.scene, edit.before.atlas, edit.before.lumels),
      hits_now_(edit.now.scene, edit.now.atlas, edit.now.lumels)
{
    for (const Lumel& lumel : edit.before.lumels.lumels)
        before_.push_back(is_buried(lumel) ? glm::vec3(0.0f)
                                           : solution.irradiance(lumel, lumel.texel));
    for (std::size_t i = 0; i < edit.partner.size(); ++i) {
        const Lumel& lumel = edit.now.lumels.lumels[i];
        wanted_.push_back(is_buried(lumel)              ? Wanted::nothing
                          : edit.partner[i] != kNoLumel ? Wanted::difference
                                                        : Wanted::all);
        guess_.push_back(edit.same[i] != kNoLumel ? before_[edit.same[i]] : glm::vec3(0.0f));
    }
}

double Correction::change(const std::vector<glm::vec3>& lights) const
{
    const SentLight sent = sent_before();
    double change = 0.0, whole = 0.0;
    std::vector<char> stays(before_.size(), 0);
    for (std::size_t i = 0; i < edit_.partner.size(); ++i) {
        const Lumel& lumel = edit_.now.lumels.lumels[i];
        const std::uint32_t j = edit_.partner[i];
        if (is_buried(lumel))
            continue;
        glm::vec3 other = lumel.emission;
        if (j != kNoLumel) {
            stays[j] = 1;
            other -= sent.emission[j];
        }
        if (!lights.empty())
            other += lumel.albedo * lights[i];
        change += double(lumel.area) * luminance(glm::abs(other));
    }
    for (std::size_t j = 0; j < before_.size(); ++j) {
        const auto area = double(edit_.before.lumels.lumels[j].area);
        whole += area * luminance(sent.emission[j] + sent.reflected[j]);
        if (!stays[j])
            change += area * luminance(sent.emission[j]);
    }
    return change > 0.0 ? change / std::max(whole, 1e-30) : 0.0;
}

/// Estimates the light of lumels that need all of it.
void Correction::look_first(UpdateRow& row)
{
    std::vector<Wanted> wanted = wanted_;
    std::replace(wanted.begin(), wanted.end(), Wanted::difference, Wanted::nothing);
    if (std::find(wanted.begin(), wanted.end(), Wanted::all) == wanted.end())
        return;
    watch_.begin("initial estimate");
    const TwoEstimates light = gather(wanted, {.whole = kFirstLook}, row);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i] == Wanted::all)
            guess_[i] = light.mean(i);
}

/// Gathers at all lumels, then with more rays where needed for an error of `residual`.
TwoEstimates Correction::gather_until(double residual, UpdateRow& row)
{
    watch_.begin("gathering");
    TwoEstimates light = gather(wanted_, {}, row);
    const double most = residual * mean_light(edit_.now.lumels, guess_);
    for (std::uint32_t effort = kMoreEffort; effort <= kMaxEffort; effort *= kMoreEffort) {
        if (light.error() <= most || row.rays > kMaxRays * wanted_.size())
            break;
        std::vector<Wanted> noisy = wanted_;
        for (std::size_t i = 0; i < noisy.size(); ++i)
            if (0.5 * double(glm::distance(light.half[0][i], light.half[1][i])) <= most)
                noisy[i] = Wanted::nothing;
        const TwoEstimates finer = gather(noisy, {.effort = effort}, row);
        for (std::size_t i = 0; i < noisy.size(); ++i)
            for (int h = 0; h < 2 && noisy[i] != Wanted::nothing; ++h)
                light.half[h][i] = finer.half[h][i];
    }
    return light;
}

TwoEstimates Correction::gather(const std::vector<Wanted>& wanted, ChangedLightOptions options,
                                UpdateRow& row)
{
    options.seed = seed_of(baked_.solver.method);
    options.centre = rule_of(baked_.solver.method) == SampleRule::centre;
    const SeenScene before{&edit_.before, &hits_before_, sent_before()};
    const SeenScene now{&edit_.now, &hits_now_, sent_now()};
    ChangedLight light =
        gather_changed_light(before, now, edit_.partner, wanted, edit_.balls, options,
                             [&](double fraction) { watch_.follow(fraction, 0); });
    row.rays += light.rays;
    return std::move(light.irradiance);
}

SentLight Correction::sent_before() const
{
    SentLight sent;
    for (std::size_t j = 0; j < before_.size(); ++j) {
        const Lumel& lumel = edit_.before.lumels.lumels[j];
        sent.emission.push_back(is_buried(lumel) ? glm::vec3(0.0f) : lumel.emission);
        sent.reflected.push_back(lumel.albedo * before_[j]);
    }
    return sent;
}

/// B°
SentLight Correction::sent_now() const
{
    const SentLight before = sent_before();
    SentLight sent;
    for (std::size_t i = 0; i < guess_.size(); ++i) {
        const Lumel& lumel = edit_.now.lumels.lumels[i];
        const std::uint32_t j = edit_.partner[i];
        const bool stays = j != kNoLumel;
        sent.emission.push_back(is_buried(lumel) ? glm::vec3(0.0f)
                                : stays          ? before.emission[j]
                                                 : lumel.emission);
        sent.reflected.push_back(stays ? before.reflected[j] : lumel.albedo * guess_[i]);
    }
    return sent;
}

/// B~ - B° of a lumel
glm::vec3 Correction::unsent(std::size_t i, const glm::vec3& light, const SentLight& sent) const
{
    const Lumel& lumel = edit_.now.lumels.lumels[i];
    const std::uint32_t j = edit_.partner[i];
    if (is_buried(lumel))
        return glm::vec3(0.0f);
    if (j != kNoLumel && light == before_[j] && looks_alike(lumel, edit_.before.lumels.lumels[j]))
        return glm::vec3(0.0f);
    return lumel.emission + lumel.albedo * light - sent.emission[i] - sent.reflected[i];
}

SignedLight Correction::carry(const std::vector<glm::vec3>& source, double error, UpdateRow& row)
{
    watch_.begin("carrying");
    const SolveScene& is = edit_.now;
    const WorldLumels world(is.scene, is.rays, is.lumels);
    const LightCarrier carrier(is.rays, is.lumels, world, hits_now_);
    SignedLight carried =
        carrier.carry(source, error, std::max(kMaxParticles * source.size(), kFewParticles),
                      seed_of(baked_.solver.method), [&](const CarryState& state) {
                          const double part = state.error > 0.0 ? error / state.error : 0.0;
                          return watch_.follow(std::min(part * part, 1.0), state.particles);
                      });
    row.particles = carried.state.particles;
    return carried;
}

std::optional<std::vector<glm::vec3>> Correction::correct(const std::vector<glm::vec3>& lights,
                                                          double residual, UpdateRow& row)
{
    look_first(row);
    // Half of the squared error for each.
    const double part = residual * std::sqrt(0.5);
    const TwoEstimates changed = gather_until(part, row);
    std::vector<glm::vec3> light = guess_, source(guess_.size());
    const SentLight sent = sent_now();
    for (std::size_t i = 0; i < light.size(); ++i) {
        glm::vec3 r = changed.mean(i) / edit_.thinned[i];
        if (wanted_[i] == Wanted::all)
            r -= guess_[i];
        if (!lights.empty())
            light[i] += lights[i];
        source[i] = unsent(i, light[i], sent) + edit_.now.lumels.lumels[i].albedo * r;
        light[i] += r;
    }
    const double mean = mean_light(edit_.now.lumels, light);
    const SignedLight carried = carry(source, part * mean, row);
    if (carried.state.gave_up)
        return std::nullopt;
    add_light(light, carried.irradiance);
    for (glm::vec3& h : light)
        h = glm::max(h, glm::vec3(0.0f));
    if (mean > 0.0)
        row.residual = std::hypot(changed.error(), carried.state.error) / mean;
    return light;
}

}  // namespace lumel
