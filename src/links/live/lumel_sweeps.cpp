#include "links/live/lumel_sweeps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lumel {
namespace {

/// Lumels between these fractions of the mean are dark; darker ones look black.
constexpr double kDarkestJudged = 0.005, kDarkJudged = 0.3;

/// Minimum assumed convergence: changes shrink at least by this factor.
constexpr double kSlowest = 1.0 - 1e-6;

double all_channels(const glm::vec4& light)
{
    return double(light.x + light.y + light.z);
}

/// Changes that shrink by a factor q leave q / (1 - q) of the last as residual; the first sweep
/// counts as not shrinking.
double still_to_come_after(double change, double before)
{
    const double factor = before > 0.0 ? std::min(change / before, kSlowest) : kSlowest;
    return std::min(change * factor / (1.0 - factor), 1.0);
}

}  // namespace

LumelSweeps::LumelSweeps(const LumelLinks& links)
    : links_(links),
      direct_(links.sky()),
      albedo_(direct_.size()),
      received_(direct_.size()),
      sent_(links.ends())
{
}

double LumelSweeps::Sums::relative() const
{
    return light > 0.0 ? std::sqrt(squares * count) / light : 0.0;
}

void LumelSweeps::begin(const std::vector<glm::vec3>& direct, const std::vector<glm::vec3>& albedo)
{
    mean_ = 0.0;
    // Emission has ended: the remaining light would take tens of sweeps to decay.
    const bool dark = std::all_of(direct.begin(), direct.end(),
                                  [](const glm::vec3& one) { return one == glm::vec3(0.0f); });
    if (dark)
        std::fill(received_.begin(), received_.end(), glm::vec4(0.0f));
    for (std::size_t i = 0; i < direct_.size(); ++i) {
        direct_[i] = glm::vec4(direct[i], 0.0f);
        albedo_[i] = glm::vec4(albedo[i], 0.0f);
        sent_[i] = albedo_[i] * (direct_[i] + received_[i]);
        mean_ += all_channels(sent_[i]);
    }
    mean_ /= double(std::max<std::size_t>(direct_.size(), 1));
    all_ = dark_ = {};
    change_ = before_ = {};
    next_ = 0;
    sweeps_ = 0;
}

glm::vec4 LumelSweeps::arriving(std::size_t i) const
{
    const std::span<const std::uint32_t> links = links_.of(i);
    const float share = 1.0f / float(links_.rays());
    glm::vec4 sum(0.0f);
    for (std::size_t k = 0; k < links.size(); k += 2)
        sum += sent_[links[k]] + sent_[links[k + 1]];  // pairs shorten the chain of additions
    return share * sum;
}

bool LumelSweeps::step(std::size_t lumels)
{
    const std::size_t end = std::min(next_ + lumels, direct_.size());
    for (; next_ < end; ++next_) {
        received_[next_] = arriving(next_);
        const glm::vec4 now = albedo_[next_] * (direct_[next_] + received_[next_]);
        const double light = all_channels(now), change = light - all_channels(sent_[next_]);
        sent_[next_] = now;
        all_.add(light, change);
        if (light > kDarkestJudged * mean_ && light < kDarkJudged * mean_)
            dark_.add(light, change);
    }
    if (next_ < direct_.size())
        return false;
    before_ = std::exchange(change_, {all_.relative(), dark_.relative()});
    mean_ = all_.light / std::max(all_.count, 1.0);
    all_ = dark_ = {};
    next_ = 0;
    ++sweeps_;
    return true;
}

StillToCome LumelSweeps::still_to_come() const
{
    return {still_to_come_after(change_.all, before_.all),
            still_to_come_after(change_.dark, before_.dark)};
}

bool LumelSweeps::rests(double residual) const
{
    const StillToCome now = still_to_come();
    return std::max(now.all, now.dark) <= residual || sweeps_ >= kMaxSweeps;
}

std::uint64_t LumelSweeps::bytes() const
{
    return (direct_.size() + albedo_.size() + received_.size() + sent_.size()) * sizeof(glm::vec4);
}

}  // namespace lumel
