#include "links/trace/final_gather.h"

#include <algorithm>

#include <glm/gtc/packing.hpp>

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
             direct.work().scene.lumels, PathSamples::hash(seed, kPartStream)),
      tracer_(direct.work(), parts_, direct.finder(), seed),
      rounds_((rays + kGatherRays - 1) / kGatherRays),
      gathered_(parts_.count()),
      sum_(sent_.size(), glm::vec3(0.0f)),
      rays_(sent_.size(), 0)
{
    for (std::size_t i = 0; i < sent_.size(); ++i)
        sent_[i] *= direct.work().lumels()[i].albedo;
}

void FinalGather::step()
{
    if (block_ == 0) {
        gathered_ = LinkSet(parts_.count());
        gathered_.rounds.emplace_back(tracer_.blocks());
    }
    const std::size_t last = std::min(block_ + kBlocksPerGather, tracer_.blocks());
    const std::vector<std::uint16_t> rays(sent_.size(), kGatherRays);
    tracer_.trace(block_, last, {rays, kLinkStream + round_, nullptr}, gathered_);
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
        LinkBlock& block = gathered_.rounds.back()[b];
        const std::size_t end = std::min((b + 1) * kLinkBlock, sent_.size());
        std::size_t row = 0;
        for (std::size_t n = b * kLinkBlock; n < end; ++n) {
            const std::uint32_t i = direct_.work().order[n];
            for (std::uint32_t p = parts_.first(i); p < parts_.end(i); ++p, ++row) {
                rays_[i] += gathered_.rays[p];
                sum_[i] += gathered_.reflected[p];
                for (std::uint32_t k = block.first[row]; k < block.first[row + 1]; ++k)
                    sum_[i] += sent_[parts_.lumel(block.target[k])];
                for (std::uint32_t k = block.first_weak[row]; k < block.first_weak[row + 1]; ++k)
                    sum_[i] += sent_[parts_.lumel(block.weak[k].part)] *
                               glm::unpackF3x9_E1x5(block.weak[k].weight);
            }
        }
        block = {};
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
