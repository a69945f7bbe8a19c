#include "links/live/light_groups.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/core/parallel.h"
#include "lights/shadow_rays.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Lumels per task: for all their light, and for the part that a move can change.
constexpr std::size_t kFoundPerTask = 256, kFollowedPerTask = 64;
/// Emitters of more sources select one for each ray, by sampling weight.
constexpr std::size_t kMaxAlone = 8;
/// Dimension pairs of a ray's random numbers.
constexpr std::uint32_t kStartPair = 0, kSourcePair = 1, kChoicePair = 2;

}  // namespace

LightGroups::LightGroups(const LinkContext& place, const GroupedLightOptions& options)
    : place_(place),
      options_(options)
{
    list_senders();
    const std::uint64_t of_one = place.lumels().size() * sizeof(glm::vec3);
    const std::size_t fit = std::max<std::size_t>(std::size_t(options.most_bytes / of_one), 1);
    groups_.resize(std::min(fit, senders_.size()));
    for (std::uint32_t s = 0; s < senders_.size(); ++s)
        groups_[std::min<std::size_t>(s, groups_.size() - 1)].senders.push_back(s);
    this->place();
    for (Group& group : groups_)
        find(group);
}

void LightGroups::list_senders()
{
    for (std::size_t s = 0; s < place_.sources.count(); ++s) {
        const LightSources::SourceInfo origin = place_.sources.origin(s);
        const auto is_it = [&](const Emitter& sender) {
            return sender.part == origin.part && sender.index == origin.index;
        };
        if (std::none_of(senders_.begin(), senders_.end(), is_it))
            senders_.push_back({.part = origin.part, .index = origin.index});
    }
}

/// Adds groups for new emitters, such as the bright part of a new sky.
void LightGroups::add_groups()
{
    const bool is_full = !groups_.empty() && groups_.back().is_shared();
    std::size_t grouped = 0;
    for (const Group& group : groups_)
        grouped += group.senders.size();
    for (std::size_t s = grouped; s < senders_.size(); ++s) {
        if (!is_full)
            groups_.emplace_back().light.resize(place_.lumels().size());
        groups_.back().senders.push_back(std::uint32_t(s));
    }
}

/// Moving surfaces may be split into different sources.
void LightGroups::place()
{
    list_senders();
    add_groups();
    for (Emitter& sender : senders_)
        sender.sources.clear();
    for (std::uint32_t s = 0; s < place_.sources.count(); ++s) {
        const LightSources::SourceInfo origin = place_.sources.origin(s);
        senders_[sender_of(origin.part, origin.index)].sources.push_back(s);
    }
}

/// Index of the emitter, or the number of emitters if there is none.
std::uint32_t LightGroups::sender_of(LightSources::Part part, std::uint32_t index) const
{
    const auto found = std::find_if(senders_.begin(), senders_.end(), [&](const Emitter& sender) {
        return sender.part == part && sender.index == index;
    });
    return std::uint32_t(found - senders_.begin());
}

bool LightGroups::set_factor(LightSources::Part part, std::uint32_t index, const glm::vec3& factor)
{
    const std::uint32_t sender = sender_of(part, index);
    if (sender == senders_.size() || senders_[sender].factor == factor)
        return false;
    senders_[sender].factor = factor;
    if (groups_[std::min<std::size_t>(sender, groups_.size() - 1)].is_shared())
        find(groups_.back());
    summed_ = false;
    return true;
}

glm::vec3 LightGroups::factor(LightSources::Part part, std::uint32_t index) const
{
    const std::uint32_t sender = sender_of(part, index);
    return sender == senders_.size() ? glm::vec3(1.0f) : senders_[sender].factor;
}

void LightGroups::find_again(LightSources::Part part, std::uint32_t index)
{
    place();
    const std::uint32_t sender = sender_of(part, index);
    if (sender < senders_.size())
        find(groups_[std::min<std::size_t>(sender, groups_.size() - 1)]);
}

void LightGroups::find(Group& group)
{
    group.light.resize(place_.lumels().size());
    parallel_for(group.light.size(), kFoundPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            group.light[i] = light_of(group, i);
    });
    summed_ = false;
}

std::uint64_t LightGroups::follow(std::uint32_t thing, const Box& before, std::size_t first,
                                  std::size_t last)
{
    const Box now = place_.rays.box(thing);
    std::atomic<std::uint64_t> found = 0;
    for (Group& group : groups_) {
        const bool moved = is_moved(group, thing);
        parallel_for(last - first, kFollowedPerTask, [&](std::size_t from, std::size_t to) {
            std::uint64_t count = 0;
            for (std::size_t i = first + from; i < first + to; ++i)
                if (moved || place_.object_of(i) == thing || may_cross(group, i, before, now)) {
                    group.light[i] = light_of(group, i);
                    ++count;
                }
            found += count;
        });
    }
    summed_ = false;
    return found;
}

/// True if one of its sources moves with the object.
bool LightGroups::is_moved(const Group& group, std::uint32_t thing) const
{
    return std::any_of(group.senders.begin(), group.senders.end(), [&](std::uint32_t s) {
        const std::vector<std::uint32_t>& sources = senders_[s].sources;
        return senders_[s].part == LightSources::Part::material &&
               std::any_of(sources.begin(), sources.end(), [&](std::uint32_t source) {
                   return place_.rays.object_of(place_.sources.origin(source).instance) == thing;
               });
    });
}

bool LightGroups::may_cross(const Group& group, std::size_t i, const Box& before,
                            const Box& now) const
{
    return std::any_of(group.senders.begin(), group.senders.end(), [&](std::uint32_t s) {
        const std::vector<std::uint32_t>& sources = senders_[s].sources;
        return std::any_of(sources.begin(), sources.end(), [&](std::uint32_t source) {
            return may_cross(source, i, before) || may_cross(source, i, now);
        });
    });
}

/// True if a ray from the lumel to the source can hit a box.
bool LightGroups::may_cross(std::uint32_t source, std::size_t i, const Box& box) const
{
    const LightSources::SourceInfo origin = place_.sources.origin(source);
    const glm::vec3& from = place_.world[i].centre;
    const float reach = place_.reach(i);
    if (origin.part == LightSources::Part::sky)
        return true;
    if (origin.sun) {
        const float far = glm::distance(from, box.centre()) + box.radius() + reach;
        return box.may_meet(from, glm::normalize(glm::vec3(origin.sun->transform[2])), far,
                            reach + far * std::tan(origin.sun->angle));
    }
    return box.may_lie_between(Box{from, from}.grown(reach),
                               origin.box.grown(place_.rays.ray_offset()));
}

glm::vec3 LightGroups::light_of(const Group& group, std::size_t i) const
{
    glm::vec3 sum(0.0f);
    if (place_.is_buried(i))
        return sum;
    for (const std::uint32_t s : group.senders)
        sum +=
            (group.is_shared() ? senders_[s].factor : glm::vec3(1.0f)) * light_of(senders_[s], i);
    return sum;
}

glm::vec3 LightGroups::light_of(const Emitter& sender, std::size_t i) const
{
    const std::uint32_t own =
        PathSamples::hash(PathSamples::hash(options_.seed, std::uint32_t(i)),
                          PathSamples::hash(std::uint32_t(sender.part), sender.index));
    if (sender.sources.size() > kMaxAlone)
        return by_many(sender, own, i);
    glm::vec3 sum(0.0f);
    for (std::uint32_t n = 0; n < sender.sources.size(); ++n)
        sum += by_one(sender.sources[n], PathSamples::hash(own, n), i);
    return sum;
}

/// Rays to all sources start at the same points, so that light from all directions sums correctly.
RayOrigin LightGroups::start_of(std::size_t i, std::uint32_t k) const
{
    const PathSamples samples(PathSamples::hash(options_.seed, std::uint32_t(i)), k);
    return place_.starts.start(i, samples.stratified(kStartPair));
}

glm::vec3 LightGroups::transmittance(const RayOrigin& start, const SourceSample& sample,
                                     std::uint32_t seed) const
{
    if (sample.irradiance == glm::vec3(0.0f))
        return glm::vec3(0.0f);
    const RaySpan ray = ray_towards(sample, start, seed);
    return glm::vec3(place_.rays.is_clear(ray) ? 1.0f : 0.0f);
}

/// A few rays, and many if they see part of the source.
glm::vec3 LightGroups::by_one(std::uint32_t source, std::uint32_t stream, std::size_t i) const
{
    SourceEstimate found;
    for (std::uint32_t k = 0; k < options_.many_rays; ++k) {
        if (k == options_.few_rays && (found.free == 0 || found.hidden == 0))
            break;
        const PathSamples samples(stream, k);
        const RayOrigin start = start_of(i, k);
        const SourceSample sample =
            place_.sources.sample(source, start, samples.stratified(kSourcePair));
        found.add(sample, transmittance(start, sample, samples.bits(kSourcePair)));
    }
    return found.light();
}

/// Each ray goes to a source selected by sampling weight.
glm::vec3 LightGroups::by_many(const Emitter& sender, std::uint32_t stream, std::size_t i) const
{
    std::vector<float> running(sender.sources.size());
    float total = 0.0f;
    const Receiver receiver = receiver_of(place_.world, i);
    for (std::size_t n = 0; n < running.size(); ++n)
        running[n] = total += place_.sources.sampling_weight(sender.sources[n], receiver);
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < options_.many_rays; ++k) {
        const PathSamples samples(stream, k);
        const RayOrigin start = start_of(i, k);
        const float mark = samples.stratified(kChoicePair).x * total;
        const auto n = std::size_t(std::upper_bound(running.begin(), running.end() - 1, mark) -
                                   running.begin());
        const float own = running[n] - (n > 0 ? running[n - 1] : 0.0f);
        if (!(own > 0.0f))
            continue;
        const SourceSample sample =
            place_.sources.sample(sender.sources[n], start, samples.stratified(kSourcePair));
        sum += transmittance(start, sample, samples.bits(kSourcePair)) * sample.irradiance *
               (total / own);
    }
    return sum / float(options_.many_rays);
}

const std::vector<glm::vec3>& LightGroups::sum()
{
    if (summed_)
        return sum_;
    sum_.assign(place_.lumels().size(), glm::vec3(0.0f));
    for (const Group& group : groups_) {
        const glm::vec3 factor =
            group.is_shared() ? glm::vec3(1.0f) : senders_[group.senders.front()].factor;
        for (std::size_t i = 0; i < sum_.size(); ++i)
            sum_[i] += factor * group.light[i];
    }
    summed_ = true;
    return sum_;
}

std::uint64_t LightGroups::bytes() const
{
    std::uint64_t bytes = sum_.size() * sizeof(glm::vec3);
    for (const Group& group : groups_)
        bytes += group.light.size() * sizeof(glm::vec3);
    return bytes;
}

}  // namespace lumel
