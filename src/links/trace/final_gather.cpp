#include "links/trace/final_gather.h"

#include <algorithm>

#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Blocks of lumels per step: a million rays.
constexpr std::size_t kBlocksPerGather = 64;
/// Standard deviation of one ray, relative to the mean of all light, in the furnished room of
/// scenes/; other rooms have less.
constexpr double kDeviation = 0.5;
constexpr double kMinGatherRays = 64.0, kMaxGatherRays = 4096.0;
/// Target error if none is given.
constexpr double kUsualError = 0.015;

}  // namespace

std::uint32_t gather_rays(double error)
{
    const double root = kDeviation / (error > 0.0 ? error : kUsualError);
    return std::uint32_t(std::clamp(root * root, kMinGatherRays, kMaxGatherRays));
}

FinalGather::FinalGather(const DirectRays& direct, std::vector<glm::vec3> received,
                         std::uint32_t rays, std::uint32_t seed)
    : direct_(direct),
      sent_(std::move(received)),
      parts_(direct.work().world, direct.work().cells, direct.work().scene.rays,
             direct.work().scene.lumels, direct.work().order, PathSamples::hash(seed, kPartStream)),
      numbers_(direct.work().scene.scene.instances.size(), parts_.count()),
      tracer_(direct.work(), parts_, numbers_, direct.finder(), seed),
      reflected_(direct.work(), parts_, numbers_, direct.finder()),
      rounds_((rays + kGatherRays - 1) / kGatherRays),
      links_(parts_.count()),
      sum_(sent_.size(), glm::vec3(0.0f)),
      rays_(sent_.size(), 0)
{
    for (std::size_t i = 0; i < sent_.size(); ++i)
        sent_[i] *= direct.work().lumels()[i].albedo;
}

void FinalGather::step()
{
    if (block_ == 0) {
        links_ = LinkTable(parts_.count());
        links_.rounds.emplace_back(tracer_.blocks());
    }
    const std::size_t last = std::min(block_ + kBlocksPerGather, tracer_.blocks());
    const std::vector<std::uint16_t> rays(sent_.size(), kGatherRays);
    tracer_.trace(block_, last, {rays, round_, 0}, links_);
    take(last);
    block_ = last;
    if (block_ == tracer_.blocks()) {
        block_ = 0;
        ++round_;
    }
}

/// Adds the results of blocks up to `last`.
void FinalGather::take(std::size_t last)
{
    for (std::size_t b = block_; b < last; ++b) {
        LinkBlock& block = links_.rounds.back()[b];
        LinkRows rows(block);
        const std::size_t end = std::min((b + 1) * kLinkBlock, sent_.size());
        for (std::size_t n = b * kLinkBlock; n < end; ++n) {
            const std::uint32_t i = direct_.work().order[n];
            take(rows.next(parts_.has_hidden(i)), i);
        }
        block = {};
    }
}

/// Adds the rays of lumel i, without the sky.
void FinalGather::take(const LinkRow& row, std::size_t i)
{
    const auto add = [&](LinkEnd end, const glm::vec3& weight, const glm::vec3& light) {
        if (numbers_.is_lost(end.number()))
            return;
        ++rays_[i];
        sum_[i] += light;
        if (numbers_.is_part(end.number()))
            sum_[i] += weight * sent_[parts_.lumel(numbers_.part(end.number()))];
    };
    for (const LinkEnd end : row.ends)
        if (end.number() != LinkNumbers::kNear)
            add(end, glm::vec3(1.0f), reflected_.at(end));
    for (std::size_t n = 0; n < row.near.size(); ++n) {
        const NearLight& near = row.near_light[n];
        add(row.near[n].end, row.near[n].weight(),
            near.distance == NearLight::kNoHit ? glm::vec3(0.0f) : near.light);
    }
}

std::vector<glm::vec3> FinalGather::irradiance() const
{
    std::vector<glm::vec3> light(sum_.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < light.size(); ++i)
        if (rays_[i] > 0)
            light[i] = sum_[i] / float(rays_[i]);
    return light;
}

}  // namespace lumel
