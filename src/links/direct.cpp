// The light of a source at a lumel is that of the source as if nothing were between, where that is
// known exactly, times the visible share, weighted by what comes along each ray:
//
//     D = ⟨open⟩ · Σ V f / Σ f,        else  D = ⟨V f⟩.
//
// So lumels that see all of a source, or nothing of it, have no noise. Random numbers of the two
// halves are independent.

#include "links/direct.h"

#include <algorithm>
#include <cmath>

#include "core/luminance.h"
#include "core/parallel.h"
#include "paths/samples.h"

namespace lumel {
namespace {

/// Lumels of one block of work, and blocks of one step.
constexpr std::size_t kBlock = 256, kBlocksPerStep = 64;
/// Rays of one half for each source: of all lumels, and of those that see a part of a source. Small
/// sources have sharp shadows.
constexpr std::uint32_t kFewRays = 8, kManyRays = 32, kFewToSmall = 16, kManyToSmall = 32;
/// Sources with less than this share of the light guessed for a lumel share their rays.
constexpr float kOwnRays = 1.0f / 16.0f;
/// The light of a lumel's cells is kept if it differs by more than this share of the brightest, and
/// that is more than this share of the mean of all lumels.
constexpr float kDiffers = 0.25f, kCounts = 0.01f;

/// Neighbours in the order of lumels, on either side, that should see the same sources.
constexpr std::size_t kNeighbours = 4;
/// Times that the many rays are doubled, at most.
constexpr std::uint32_t kMostRefined = 8;
/// Halves that differ by more than this share of their mean, and of that of all lumels, are
/// uncertain.
constexpr double kUncertain = 0.02, kUncertainOfAll = 0.01;

/// Sources that a point beside the lumels asks for light, at most.
constexpr std::uint32_t kMostSought = 2;

/// Sets many rays apart from few among the random streams of a lumel.
constexpr std::uint32_t kManyStream = 0x10000;

/// Dimension pairs of a ray's random numbers.
constexpr std::uint32_t kStartPair = 0, kChoicePair = 1, kSourcePair = 2;

}  // namespace

/// What the rays to one source tell, of a lumel or of a cell.
struct DirectFinder::Sums {
    glm::vec3 open{0.0f};    ///< Σ of what is known exactly
    glm::vec3 passed{0.0f};  ///< Σ V f
    float offered = 0.0f;    ///< Σ f by luminance
    glm::vec3 seen{0.0f};    ///< Σ V f by luminance of f
    std::uint32_t rays = 0, free = 0, hidden = 0;
    bool exact = true;

    void add(const SourceSample& sample, const glm::vec3& passing)
    {
        const float offer = float(luminance(sample.irradiance));
        ++rays;
        if (sample.open)
            open += *sample.open;
        else
            exact = false;
        passed += passing * sample.irradiance;
        offered += offer;
        seen += passing * offer;
        if (offer > 0.0f)
            ++(passing == glm::vec3(0.0f) ? hidden : free);
    }
    glm::vec3 light() const
    {
        if (rays == 0)
            return glm::vec3(0.0f);
        if (!exact)
            return passed / float(rays);
        return offered > 0.0f ? open / float(rays) * (seen / offered) : glm::vec3(0.0f);
    }
};

struct DirectFinder::Found {
    glm::vec3 half[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    OfCells cells{};
    std::uint32_t seen = 0;
    bool uncertain = false;
    bool exact = true;  ///< of all sources what they send as if nothing were between is known
    std::uint64_t rays = 0;
};

/// One source of several, and what its light counts for the others.
struct DirectFinder::Choice {
    std::uint32_t source;
    float factor;
};

DirectFinder::DirectFinder(const LinkScene& place, const LightSources& sources,
                           const RayStarts& starts, const std::vector<std::uint32_t>& order,
                           std::uint32_t seed)
    : place_(place),
      sources_(sources),
      starts_(starts),
      order_(order),
      seed_(seed),
      half_{std::vector<glm::vec3>(order.size()), std::vector<glm::vec3>(order.size())},
      seen_(order.size()),
      uncertain_(order.size()),
      varying_(order.size(), kSame),
      blocks_((order.size() + kBlock - 1) / kBlock)
{
}

/// Sources that send much have rays of their own; `rest`: running sums over all sources of what the
/// others might send, empty if there are none.
void DirectFinder::share_out_rays(const glm::vec3& at, float size, std::vector<std::uint32_t>& own,
                                  std::vector<float>& rest) const
{
    own.clear();
    rest.resize(sources_.count());
    float total = 0.0f;
    for (std::uint32_t s = 0; s < sources_.count(); ++s)
        total += rest[s] = sources_.guess(s, at, size);
    float sum = 0.0f;
    for (std::uint32_t s = 0; s < sources_.count(); ++s) {
        if (rest[s] >= kOwnRays * total) {
            own.push_back(s);
            rest[s] = 0.0f;
        }
        rest[s] = sum += rest[s];
    }
    if (!(sum > 0.0f))
        rest.clear();
}

/// By running sums over the sources.
DirectFinder::Choice DirectFinder::choose(const std::vector<float>& running, float at)
{
    const float mark = at * running.back();
    const auto found = std::upper_bound(running.begin(), running.end() - 1, mark);
    const auto source = std::uint32_t(found - running.begin());
    const float own = *found - (source > 0 ? running[source - 1] : 0.0f);
    return {source, own > 0.0f ? running.back() / own : 0.0f};
}

/// Looks at a point of a source; factor: times its light, where it stands for others too.
DirectFinder::Seen DirectFinder::look(const RayStart& start, std::size_t source, float factor,
                                      const glm::vec2& at, std::uint32_t seed) const
{
    Seen seen{sources_.sample(source, start, at)};
    SourceSample& sample = seen.sample;
    if (factor != 1.0f) {
        sample.irradiance *= factor;
        sample.open.reset();
    }
    if (sample.irradiance == glm::vec3(0.0f))
        return seen;
    seen.passing = std::isinf(sample.distance)
                       ? place_.rays.passing_out(start.position, sample.direction, seed)
                       : place_.rays.passing(start.position,
                                             start.position + sample.distance * sample.direction,
                                             place_.rays.lift(), seed);
    return seen;
}

glm::vec3 DirectFinder::light_at(const RayStart& start, float size, std::uint32_t seed) const
{
    const auto place_on = [&](std::uint32_t k) {
        const std::uint32_t own = PathSamples::hash(seed, k);
        return glm::vec2(PathSamples::to_unit(own),
                         PathSamples::to_unit(PathSamples::hash(own, 1)));
    };
    glm::vec3 light(0.0f);
    const auto add = [&](std::size_t source, float factor, std::uint32_t k) {
        const Seen seen = look(start, source, factor, place_on(k), PathSamples::hash(seed, ~k));
        light += seen.passing * seen.sample.irradiance;
    };
    const auto count = std::uint32_t(sources_.count());
    if (count <= kMostSought) {
        for (std::uint32_t s = 0; s < count; ++s)
            add(s, 1.0f, s);
        return light;
    }
    // Some, by what they may send.
    std::vector<float> running(count);
    float sum = 0.0f;
    for (std::uint32_t s = 0; s < count; ++s)
        running[s] = sum += sources_.guess(s, start.position, size);
    for (std::uint32_t k = 0; k < kMostSought; ++k) {
        const Choice choice =
            choose(running, (place_on(count + k).x + float(k)) / float(kMostSought));
        add(choice.source, choice.factor / float(kMostSought), k);
    }
    return light;
}

/// Adds what the rays to a source find, or to the rest of the sources together.
void DirectFinder::add_rays(std::uint32_t i, const RaysTo& to, bool many, Found& found) const
{
    const bool small = to.alone && sources_.is_small(to.source);
    const std::uint32_t rays =
        many ? (small ? kManyToSmall : kManyRays) << level_ : (small ? kFewToSmall : kFewRays);
    std::array<Sums, kCells> of_cells;
    Sums of_both;
    for (std::uint32_t h = 0; h < 2; ++h) {
        Sums sums;
        const std::uint32_t stream = PathSamples::hash(PathSamples::hash(seed_, 2 * i + h),
                                                       2 * to.source + (to.alone ? 0 : 1) +
                                                           (many ? kManyStream << level_ : 0));
        for (std::uint32_t k = 0; k < rays; ++k) {
            const PathSamples samples(stream, k);
            const RayStart start = starts_.start(i, samples.stratified(kStartPair));
            const Choice choice = to.alone ? Choice{to.source, 1.0f}
                                           : choose(*to.rest, samples.stratified(kChoicePair).x);
            const Seen seen = look(start, choice.source, choice.factor,
                                   samples.stratified(kSourcePair), samples.bits(kSourcePair));
            for (Sums* into : {&sums, &of_both, &of_cells[start.cell]})
                into->add(seen.sample, seen.passing);
        }
        found.half[h] += sums.light();
    }
    found.rays += of_both.free + of_both.hidden;
    found.uncertain = found.uncertain || (of_both.free > 0 && of_both.hidden > 0);
    found.exact = found.exact && of_both.exact;
    if (of_both.free > 0)
        found.seen |= 1u << (to.alone ? to.source % 32 : 31);
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
        found.cells[c] += (of_cells[c].rays > 0 ? of_cells[c] : of_both).light();
}

DirectFinder::Found DirectFinder::find(std::uint32_t i, bool many) const
{
    Found found;
    const Lumel& lumel = place_.lumels.lumels[i];
    if (lumel.flags & kLumelBuried)
        return found;
    std::vector<std::uint32_t> own;
    std::vector<float> rest;
    share_out_rays(starts_.start(i, glm::vec2(0.5f)).position, lumel.size, own, rest);
    for (const std::uint32_t source : own)
        add_rays(i, {.alone = true, .source = source}, many, found);
    if (!rest.empty())
        add_rays(i, {.alone = false, .rest = &rest}, many, found);
    // A ray for a cell tells something only if it tells all.
    if (!many && !found.exact)
        found.cells.fill(0.5f * (found.half[0] + found.half[1]));
    return found;
}

/// Takes over what was found of lumel i.
void DirectFinder::keep(std::uint32_t i, const Found& found, Block& block)
{
    half_[0][i] = found.half[0];
    half_[1][i] = found.half[1];
    uncertain_[i] = found.uncertain;
    if (first_pass_)
        seen_[i] = found.seen;
    block.rays += found.rays;
    const auto by_light = [](const glm::vec3& one, const glm::vec3& other) {
        return luminance(one) < luminance(other);
    };
    const auto [least, most] =
        std::minmax_element(found.cells.begin(), found.cells.end(), by_light);
    if (luminance(*most) - luminance(*least) > double(kDiffers) * luminance(*most)) {
        block.lumel.push_back(i);
        block.cells.push_back(found.cells);
    }
}

bool DirectFinder::step()
{
    const std::vector<std::uint32_t>& list = first_pass_ ? order_ : many_;
    if (first_pass_ && sources_.count() == 0)
        return false;
    const std::size_t last_block = std::min(done_ + kBlocksPerStep, blocks_.size());
    parallel_for(last_block - done_, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = done_ + first; b < done_ + last; ++b) {
            Block& block = blocks_[b];
            for (std::size_t k = b * kBlock; k < std::min((b + 1) * kBlock, list.size()); ++k)
                keep(list[k], find(list[k], !first_pass_), block);
        }
    });
    done_ = last_block;
    if (done_ < blocks_.size())
        return true;

    // The pass ends.
    if (first_pass_)
        mark_uncertain_hidden();
    keep_cells();
    const bool more = first_pass_ && !many_.empty();
    first_pass_ = false;
    if (more) {
        blocks_.assign((many_.size() + kBlock - 1) / kBlock, {});
        done_ = 0;
    }
    return more;
}

bool DirectFinder::refine()
{
    const double mean = mean_of_all();
    // What sees a part of a source stays: to drop those whose halves agree by chance would state
    // too small an error.
    std::erase_if(many_, [&](std::uint32_t i) { return !uncertain_[i] && !differs(i, mean); });
    if (many_.empty() || level_ == kMostRefined)
        return false;
    ++level_;
    blocks_.assign((many_.size() + kBlock - 1) / kBlock, {});
    done_ = 0;
    return true;
}

std::uint64_t DirectFinder::rays_to_refine() const
{
    return std::uint64_t(many_.size()) * (2 * kManyRays << (level_ + 1));
}

double DirectFinder::fraction() const
{
    return blocks_.empty() ? 1.0 : double(done_) / double(blocks_.size());
}

double DirectFinder::mean_of_all() const
{
    double mean = 0.0;
    for (std::size_t i = 0; i < half_[0].size(); ++i)
        mean += luminance(this->mean(i));
    return mean / double(std::max<std::size_t>(half_[0].size(), 1));
}

/// Do the halves differ by more than counts?
bool DirectFinder::differs(std::size_t i, double mean) const
{
    const double apart = std::abs(luminance(half_[0][i]) - luminance(half_[1][i]));
    return apart > kUncertain * luminance(this->mean(i)) && apart > kUncertainOfAll * mean;
}

/// Lumels that see a part of a source, those whose halves differ, and those that see other sources
/// than a neighbour on their chart: few rays miss thin shadows.
void DirectFinder::mark_uncertain_hidden()
{
    const std::vector<std::uint32_t> by_side = lumels_by_side(place_.lumels);
    const int width = place_.lumels.width, height = place_.lumels.height;
    std::vector<char> needs = uncertain_;
    const double mean = mean_of_all();
    for (std::size_t i = 0; i < needs.size(); ++i)
        if (differs(i, mean))
            needs[i] = 1;
    parallel_for(place_.lumels.lumels.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Lumel& lumel = place_.lumels.lumels[i];
            const int x = int(lumel.texel) % width, y = int(lumel.texel) / width;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height)
                        continue;
                    const std::size_t texel =
                        std::size_t(y + dy) * std::size_t(width) + std::size_t(x + dx);
                    const std::uint32_t other =
                        by_side[2 * texel + (lumel.flags & kLumelBack ? 1 : 0)];
                    if (other == kNoLumel || place_.lumels.lumels[other].chart != lumel.chart)
                        continue;
                    if (uncertain_[other] || seen_[other] != seen_[i])
                        needs[i] = 1;
                }
        }
    });
    // Charts may be small: neighbours in space, as far as the order has them.
    for (std::size_t o = 0; o < order_.size(); ++o)
        for (std::size_t n = o + 1; n < std::min(o + 1 + kNeighbours, order_.size()); ++n) {
            const std::uint32_t i = order_[o], j = order_[n];
            if (uncertain_[i] || uncertain_[j] || seen_[i] != seen_[j])
                needs[i] = needs[j] = 1;
        }
    for (const std::uint32_t i : order_)
        if (needs[i] && !(place_.lumels.lumels[i].flags & kLumelBuried))
            many_.push_back(i);
}

/// Takes over what the blocks of a pass found of cells.
void DirectFinder::keep_cells()
{
    const double mean = mean_of_all();
    std::vector<char> again(first_pass_ ? 0 : half_[0].size(), 0);
    if (!first_pass_)
        for (const std::uint32_t i : many_)
            again[i] = 1;

    std::vector<OfCells> kept;
    std::vector<std::uint32_t> index(varying_.size(), kSame);
    const auto keep = [&](std::uint32_t i, const OfCells& cells) {
        double most = 0.0;
        for (const glm::vec3& cell : cells)
            most = std::max(most, luminance(cell));
        if (most <= double(kCounts) * mean)
            return;
        index[i] = std::uint32_t(kept.size());
        kept.push_back(cells);
    };
    if (!first_pass_)
        for (std::uint32_t i = 0; i < varying_.size(); ++i)
            if (varying_[i] != kSame && !again[i])
                keep(i, cells_[varying_[i]]);
    for (Block& block : blocks_) {
        for (std::size_t k = 0; k < block.lumel.size(); ++k)
            keep(block.lumel[k], block.cells[k]);
        rays_ += block.rays;
        block = {};
    }
    cells_ = std::move(kept);
    varying_ = std::move(index);
}

}  // namespace lumel
