#include "links/sweeps/device_sweeps.h"

#include <algorithm>
#include <utility>

namespace lumel {
namespace {

std::size_t groups_of(std::size_t count)
{
    return (count + kGroup - 1) / kGroup;
}

}  // namespace

DeviceSweeps::Levels::Levels(const gpu::Device& device, const LevelCorrection& levels)
    : group_of_part(device, levels.groups().of_part, "groups of sub-lumels"),
      members(device, levels.members(), "members of groups"),
      spans(device, levels.spans(), "spans of groups"),
      areas(device, levels.areas(), "areas of sub-lumels"),
      factors(device, levels.groups().count, gpu::Buffer::Place::host, "factors of groups"),
      sums(device, levels.spans().size(), gpu::Buffer::Place::host, "sums of groups")
{
}

DeviceSweeps::DeviceSweeps(const gpu::Device& device, const std::vector<glm::vec3>& albedo,
                           const SweepDispatches& dispatches)
    : device_(device),
      albedo_(albedo),
      parts_(albedo.size()),
      dispatches_{.probe = dispatches.probe,
                  .most = std::min(dispatches.most, device.max_groups())},
      gather_(device),
      receive_(device),
      sum_groups_(device),
      correct_(device),
      albedo_of_part_(device, albedo, "albedo of sub-lumels"),
      source_(device, parts_, "source term of sweeps"),
      share_of_ray_(device, parts_, "share of a ray"),
      gathered_(device, parts_, "light gathered"),
      sent_(device, parts_ + 1, "light sent"),
      next_(device, parts_ + 1, "light sent next"),
      received_(device, parts_, "light received"),
      sums_(device, groups_of(parts_), gpu::Buffer::Place::host, "sums of sweeps"),
      pacer_(device)
{
}

std::uint64_t DeviceSweeps::bytes(std::size_t parts)
{
    constexpr std::uint64_t kOfLevels = 2 * sizeof(std::uint32_t) + sizeof(float);
    constexpr std::uint64_t kOfPart =
        2 * sizeof(glm::vec3) + 4 * sizeof(glm::vec4) + sizeof(float) + kOfLevels;
    return parts * kOfPart +
           groups_of(parts) * (sizeof(SweepSums) + sizeof(GroupSpan) + sizeof(GroupSums));
}

void DeviceSweeps::begin(const DeviceLinks& links, const SourceTerm& source,
                         const std::vector<glm::vec3>& received)
{
    pacer_.finish();
    links_ = &links;
    levels_.reset();
    std::vector<glm::vec4> sent(parts_ + 1, glm::vec4(0.0f));
    for (std::size_t p = 0; p < received.size(); ++p)
        sent[p] = glm::vec4(radiosity(albedo_[p], received[p]), 0.0f);
    light_ = 0.0;
    for (const glm::vec4& light : sent)
        light_ += sum_of_channels(light);
    std::vector<float> shares(parts_);
    for (std::size_t p = 0; p < parts_; ++p)
        shares[p] = source.share_of_ray(p);
    sent_.upload(sent);
    next_.upload(std::vector<glm::vec4>(parts_ + 1, glm::vec4(0.0f)));
    share_of_ray_.upload(shares);
    source_.upload(source.light);
    gathered_.upload(source.light);
}

double DeviceSweeps::light(std::size_t) const
{
    return light_;
}

/// Runs a kernel for at least `threads` invocations, in dispatches that the device allows.
template <class Shader>
void DeviceSweeps::dispatch(const char* kind, std::size_t threads,
                            const gpu::Kernel<Shader>& kernel,
                            const typename Shader::Bindings& given, typename Shader::Params params)
{
    const auto groups = std::uint32_t(groups_of(threads));
    for (std::uint32_t begin = 0; begin < groups; begin += dispatches_.most)
        pacer_.work(kind, std::min(dispatches_.most, groups - begin), dispatches_.probe,
                    [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                        params.range = {(begin + first) * kGroup, (begin + last) * kGroup};
                        commands.dispatch(kernel, given, params, (last - first) * kGroup);
                    });
}

std::array<LightChange, 1> DeviceSweeps::sweep(const std::array<float, 1>& darkest)
{
    for (const DeviceLinks::Slab& slab : links_->slabs())
        dispatch("gather links", slab.slices.size() * kSliceRows, gather_,
                 {.slices = slab.slices, .words = slab.words, .sent = sent_, .gathered = gathered_},
                 {.slices = std::uint32_t(slab.slices.size())});
    dispatch("receive light", parts_, receive_,
             {.albedo = albedo_of_part_,
              .source = source_,
              .share_of_ray = share_of_ray_,
              .sent = sent_,
              .gathered = gathered_,
              .next = next_,
              .received = received_,
              .sums = sums_},
             {.parts = std::uint32_t(parts_), .darkest = darkest[0]});
    pacer_.finish();
    LightChange change;
    for (std::size_t s = 0; s < sums_.size(); ++s)
        change.add(sums_.mapped()[s]);
    return {change};
}

double DeviceSweeps::correct(const LevelCorrection& levels, std::size_t)
{
    if (!levels_)
        levels_.emplace(device_, levels);
    dispatch("sum groups", levels_->spans.size() * kGroup, sum_groups_,
             {.members = levels_->members,
              .spans = levels_->spans,
              .areas = levels_->areas,
              .sent = sent_,
              .next = next_,
              .sums = levels_->sums},
             {});
    pacer_.finish();
    const LevelCorrection::Found found =
        levels.find({levels_->sums.mapped(), levels_->sums.size()});
    std::ranges::copy(found.factors,
                      reinterpret_cast<glm::vec4*>(levels_->factors.buffer().mapped()));
    dispatch("correct levels", parts_, correct_,
             {.group_of_part = levels_->group_of_part, .factors = levels_->factors, .next = next_},
             {.parts = std::uint32_t(parts_)});
    return found.residual;
}

std::vector<glm::vec3> DeviceSweeps::received()
{
    pacer_.finish();
    return received_.download();
}

void DeviceSweeps::advance()
{
    std::swap(sent_, next_);
}

}  // namespace lumel
