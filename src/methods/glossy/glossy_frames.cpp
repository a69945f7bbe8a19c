// Frames that share part of their work: with a new eye, changed light, or moved objects.
//
//   [BSS05] Section 6: the same random numbers in all frames, and the previous solution as a good
//           guess to start the iteration from.

#include <algorithm>

#include "methods/glossy/glossy.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Fraction of a frame's shooters drawn by area: light can reach lumels that were dark before.
constexpr float kFrameByArea = 0.1f;

}  // namespace

void GlossyIllumination::rewind()
{
    const std::size_t before = (state_.iterations + 1) % 2;
    const bool is_first = !held_;
    if (is_first)
        held_.emplace(Held{{*device_, count_},
                           {*device_, count_},
                           {*device_, count_},
                           {*device_, count_},
                           {*device_, last_.size()},
                           {*device_, kMaxGlossyBatch},
                           {*device_, view(mean_exitance())}});
    pacer_.work("rewind", [&](gpu::Commands& commands) {
        const auto carry = [&](const gpu::Buffer& now, const gpu::Buffer& held) {
            commands.copy(is_first ? now : held, is_first ? held : now, held.bytes());
        };
        carry(emission_.buffer(), held_->emission.buffer());
        carry(exitance_.buffer(), held_->exitance.buffer());
        carry(diffuse_.buffer(), held_->diffuse.buffer());
        carry(near_.buffer(), held_->near.buffer());
        carry(last_.buffer(), held_->last.buffer());
        carry(eyes_[before].buffer(), held_->eyes.buffer());
    });
    pacer_.finish();
    figures_.drop();
    carried_.restart();
    iteration_ = next_shot_ = 0;
}

void GlossyIllumination::forget_frames()
{
    pacer_.finish();
    held_.reset();
}

void GlossyIllumination::set_emission(std::span<const glm::vec3> given)
{
    if (given.size() != count_)
        throw Error(ErrorKind::input, "emission", "must be given for every lumel");
    std::vector<glm::vec3> emission(given.begin(), given.end());
    for (std::size_t i = 0; i < count_; ++i)
        if (lumels_->lumels[i].flags & kLumelBuried)
            emission[i] = glm::vec3(0.0f);
    leave_phases();
    emitted_power_ = emitted_power(*lumels_, emission);
    rewind();
    const std::vector<glm::vec3> before = emission_.download();
    emission_.upload(emission);
    const auto add_change = [&](const gpu::Array<glm::vec3>& from, gpu::Array<glm::vec3>& to) {
        std::vector<glm::vec3> values = from.download();
        for (std::size_t i = 0; i < count_; ++i)
            values[i] = glm::max(values[i] + emission[i] - before[i], glm::vec3(0.0f));
        to.upload(values);
    };
    add_change(exitance_, exitance_);
    add_change(diffuse_, diffuse_);
    restart();
    if (eye_)
        eye_->restart(pacer_);
    pacer_.work("power", [&](gpu::Commands& commands) {
        area_power_.build(commands, emission_, surface_, 1.0f, reflecting_area_);
    });
    draw_in_proportion_to(held_->mean_exitance, kFrameByArea);
}

std::vector<glm::vec3> GlossyIllumination::mean_exitance()
{
    const std::vector<glm::vec3> arriving = irradiance();
    std::vector<glm::vec3> exitance = emission_.download();
    // The lobes' albedo counts as 1: drawing weights need not be exact.
    for (std::size_t i = 0; i < count_; ++i) {
        const Gloss& gloss = lumels_->gloss[i];
        exitance[i] += (particles_ ? gloss.diffuse : gloss.diffuse + gloss.specular) * arriving[i];
    }
    return exitance;
}

std::vector<float> GlossyIllumination::brightness()
{
    const std::vector<glm::vec3> exitance =
        held_ ? held_->mean_exitance.download() : mean_exitance();
    std::vector<float> brightness(count_, 0.0f);
    double power = 0.0;
    for (std::uint32_t j = 0; j < count_; ++j) {
        brightness[j] = float(luminance(exitance[j]));
        power += double(brightness[j]) * double(lumels_->lumels[j].area);
    }
    for (float& value : brightness)
        value = power > 0.0 ? float(double(value) / power) : 0.0f;
    return brightness;
}

void GlossyIllumination::look_at(std::span<const EyePoint> points,
                                 std::span<const float> brightness, const EyeSampling& sampling)
{
    pacer_.finish();
    const std::vector<glm::vec3> emission = emission_.download();
    eye_.emplace(*device_, options_.views.projection, points, brightness, sampling);
    set_emission(emission);
}

void GlossyIllumination::accumulate_at(std::span<const EyePoint> points)
{
    if (points.empty())
        return;
    const EyeSampling all{{0, std::uint32_t(points.size())}, 0, 0};
    eye_.emplace(*device_, options_.views.projection, points, std::vector<float>(count_, 0.0f),
                 all);
    eye_->restart(pacer_);
}

void GlossyIllumination::go_on_from(GlossyIllumination& before, float kept)
{
    if (before.count_ != count_ || before.batch_ != batch_ || before.paper_ != paper_)
        throw Error(ErrorKind::input, "the frame before",
                    "must have the same lumels, batches and scheme");
    pacer_.finish();
    const std::vector<glm::vec3> mean = before.irradiance();
    if (phases_) {
        go_on_in_phases(mean, kept);
        return;
    }
    const std::vector<glm::vec3> emission = emission_.download();
    std::vector<glm::vec3> exitance = emission, diffuse = emission;
    if (paper_) {
        // As published: the iteration continues, with the light of its last shooters.
        const std::vector<glm::vec3> emitted = before.emission_.download();
        const std::vector<glm::vec3> all = before.exitance_.download();
        const std::vector<glm::vec3> matte = before.diffuse_.download();
        for (std::size_t i = 0; i < count_; ++i) {
            exitance[i] += glm::max(all[i] - emitted[i], glm::vec3(0.0f));
            diffuse[i] += glm::max(matte[i] - emitted[i], glm::vec3(0.0f));
        }
        last_.upload(before.last_.download());
        eyes_[1].upload(before.eyes_[(before.state_.iterations + 1) % 2].download());
    } else {
        // The mean is less noisy than any iteration. Without particles, lobes follow in the next
        // one.
        for (std::size_t i = 0; i < count_; ++i)
            diffuse[i] += lumels_->gloss[i].diffuse * mean[i];
        exitance = diffuse;
    }
    exitance_.upload(exitance);
    diffuse_.upload(diffuse);
    has_before_ = paper_;
    goes_on_ = true;
    keep_average_of(before, kept);
    draw_in_proportion_to(exitance_, 0.0f);
}

/// Scales the sums of the previous frame's halves to a number of iterations.
void GlossyIllumination::keep_average_of(const GlossyIllumination& before, float kept)
{
    if (!(kept > 0.0f) || std::min(before.batches_[0], before.batches_[1]) <= 0.0f)
        return;
    const auto scaled = [&](const gpu::Array<glm::vec3>& from, gpu::Array<glm::vec3>& to) {
        std::vector<glm::vec3> sums = from.download();
        for (std::size_t h = 0; h < 2; ++h)
            for (std::size_t i = 0; i < count_; ++i)
                sums[h * count_ + i] *= 0.5f * kept / before.batches_[h];
        to.upload(sums);
    };
    scaled(before.sums_, sums_);
    scaled(before.absorbed_, absorbed_);
    batches_ = {0.5f * kept, 0.5f * kept};
}

}  // namespace lumel
