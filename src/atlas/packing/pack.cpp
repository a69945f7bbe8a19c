#include "atlas/packing/pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "base/core/error.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

namespace lumel {

namespace {

constexpr int kSideStep = 4;           // block-compressed textures need multiples of 4
constexpr int kDefaultSide = 512;      // detail for a room; seconds to minutes on a small machine
constexpr double kDefaultFill = 0.25;  // below this, gutters and tiny charts fill a default map
constexpr int kBisections = 9;         // density to 0.1 per cent
constexpr double kSideGrowth = 1.02;
// Fill ratios of pages to try: fuller pages are fewer, if everything fits.
constexpr std::array kPageFills = {0.97, 0.94, 0.91, 0.88, 0.85, 0.8, 0.7, 0.5};

/// Rectangles and rules for placing them.
struct Task {
    const std::vector<Rectangle>& rectangles;
    int gutter;
    int pages = 1;

    static glm::ivec2 texels(const Rectangle& rectangle, double density)
    {
        // Larger than any map; keeps the conversion defined.
        constexpr double kHuge = 1 << 24;
        return glm::ivec2(
            glm::clamp(glm::round(rectangle.size * rectangle.density.in(density)), 1.0, kHuge));
    }

    /// Texels of all rectangles with their gutters.
    double footprint(double density) const
    {
        double sum = 0.0;
        for (const Rectangle& rectangle : rectangles) {
            const glm::dvec2 padded(texels(rectangle, density) + gutter);
            sum += padded.x * padded.y;
        }
        return sum;
    }

    /// Texels of all rectangles.
    double covered(double density) const
    {
        double sum = 0.0;
        for (const Rectangle& r : rectangles)
            sum += r.size.x * r.size.y * r.density.in(density)*r.density.in(density);
        return sum;
    }

    /// Texels per (texel/m)² of the common density, without fixed rectangles [m²].
    double area() const { return std::max(covered(1.0) - covered(0.0), 1e-30); }

    /// Longest side of rectangles of the common density [m].
    double longest_side() const
    {
        double longest = 0.0;
        for (const Rectangle& r : rectangles)
            if (r.density.fixed == 0.0)
                longest = std::max(longest, r.density.relative * std::max(r.size.x, r.size.y));
        return longest;
    }

    double largest_fixed() const
    {
        double largest = 0.0;
        for (const Rectangle& r : rectangles)
            largest = std::max(largest, r.density.fixed);
        return largest;
    }
};

/// Places some of the rectangles in a square of that side.
bool pack_page(const Task& task, double density, int side, std::span<const std::uint32_t> chosen,
               const glm::ivec2& corner, std::vector<PackedRectangle>& placed)
{
    std::vector<stbrp_rect> rectangles(chosen.size());
    for (std::size_t i = 0; i < rectangles.size(); ++i) {
        const glm::ivec2 padded = Task::texels(task.rectangles[chosen[i]], density) + task.gutter;
        if (padded.x > side || padded.y > side)
            return false;
        rectangles[i] = {int(chosen[i]), padded.x, padded.y, 0, 0, 0};
    }
    // The packer's own sort leaves the order of equal items unspecified, so items are sorted first.
    std::stable_sort(rectangles.begin(), rectangles.end(),
                     [](const stbrp_rect& a, const stbrp_rect& b) {
                         return a.h > b.h || (a.h == b.h && a.w > b.w);
                     });
    // Lowest position first, else tightest position first: neither is always better.
    std::vector<stbrp_node> nodes(std::size_t(side), stbrp_node{});
    const auto packs_with = [&](int heuristic) {
        stbrp_context context{};
        stbrp_init_target(&context, side, side, nodes.data(), side);
        stbrp_setup_heuristic(&context, heuristic);
        return stbrp_pack_rects(&context, rectangles.data(), int(rectangles.size())) != 0;
    };
    if (!packs_with(STBRP_HEURISTIC_Skyline_BL_sortHeight) &&
        !packs_with(STBRP_HEURISTIC_Skyline_BF_sortHeight))
        return false;
    for (const stbrp_rect& rectangle : rectangles)
        placed[std::size_t(rectangle.id)] = {corner + glm::ivec2(rectangle.x, rectangle.y) +
                                                 task.gutter / 2,
                                             glm::ivec2(rectangle.w, rectangle.h) - task.gutter};
    return true;
}

/// The rectangles of each page, for as few pages as hold them at this fill ratio.
std::vector<std::vector<std::uint32_t>> deal(const Task& task, double density, int side,
                                             double fill)
{
    std::vector<Lot> lots;
    for (const Rectangle& r : task.rectangles) {
        lots.resize(std::max(lots.size(), std::size_t(r.lot) + 1));
        const glm::dvec2 padded(Task::texels(r, density) + task.gutter);
        lots[r.lot].group = r.group;
        lots[r.lot].weight += padded.x * padded.y;
    }
    const std::vector<int> page_of_lot = deal_to_pages(lots, fill * side * side, task.pages);
    std::vector<std::vector<std::uint32_t>> pages;
    for (std::uint32_t i = 0; i < task.rectangles.size(); ++i) {
        const std::size_t page = std::size_t(page_of_lot[task.rectangles[i].lot]);
        pages.resize(std::max(pages.size(), page + 1));
        pages[page].push_back(i);
    }
    return pages;
}

std::optional<Packing> pack_pages(const Task& task, double density, int side,
                                  const std::vector<std::vector<std::uint32_t>>& dealt)
{
    const Pages pages{int(dealt.size()), side};
    Packing packing{pages, density, std::vector<PackedRectangle>(task.rectangles.size())};
    for (int page = 0; page < pages.count; ++page)
        if (!pack_page(task, density, side, dealt[std::size_t(page)], pages.corner(page),
                       packing.rectangles))
            return std::nullopt;
    return packing;
}

std::optional<Packing> try_pack(const Task& task, double density, int side)
{
    if (task.footprint(density) > double(task.pages) * side * side)
        return std::nullopt;
    if (task.pages == 1) {
        std::vector<std::uint32_t> all(task.rectangles.size());
        std::iota(all.begin(), all.end(), 0u);
        return pack_pages(task, density, side, {all});
    }
    for (const double fill : kPageFills)
        if (const auto dealt = deal(task, density, side, fill); int(dealt.size()) <= task.pages)
            if (std::optional<Packing> packing = pack_pages(task, density, side, dealt))
                return packing;
    return std::nullopt;
}

/// The densest packing in a square of this side, at most `limit` [texels/m].
std::optional<Packing> fill(const Task& task, int side, double limit)
{
    // Upper bound of the density, even if all rectangles are rounded down.
    double above = std::min(2.0 * side * std::sqrt(task.pages / task.area()), limit);
    if (std::optional<Packing> packing = try_pack(task, above, side))
        return packing;
    // At `least` every rectangle is a single texel.
    const double least = 1.0 / std::max(task.longest_side(), 1e-30);
    double below = above;
    std::optional<Packing> best;
    while (!best && below > least) {
        above = below;
        below = std::max(0.7 * below, least);
        best = try_pack(task, below, side);
    }
    for (int i = 0; best && i < kBisections; ++i) {
        const double middle = std::sqrt(below * above);
        if (std::optional<Packing> packing = try_pack(task, middle, side)) {
            best = std::move(packing);
            below = middle;
        } else {
            above = middle;
        }
    }
    return best;
}

int round_up_to_step(double side)
{
    return int(std::ceil(side / kSideStep)) * kSideStep;
}

[[noreturn]] void throw_too_small(const Task& task, int side)
{
    const int enough =
        std::max(round_up_to_step(kSideGrowth * std::sqrt(task.footprint(0.0))), side + kSideStep);
    throw Error(ErrorKind::input, "",
                fmt::format("{} charts do not fit into a map of {} × {} texels even at {}; use "
                            "{} × {} or more",
                            task.rectangles.size(), side, side,
                            task.largest_fixed() > 0.0 ? "one texel each where no density is set"
                                                       : "one texel each",
                            enough, enough));
}

/// The smallest square, in steps, that holds everything at this density.
std::optional<Packing> grow_to_fit(const Task& task, double density, int max_side)
{
    const double start = std::sqrt(task.footprint(density));
    for (int side = start < max_side ? round_up_to_step(start) : max_side + 1; side <= max_side;
         side = std::min(round_up_to_step(kSideGrowth * side + 1.0),
                         side < max_side ? max_side : max_side + 1))
        if (std::optional<Packing> packing = try_pack(task, density, side))
            return packing;
    return std::nullopt;
}

std::optional<Packing> pack_default(const Task& task, int max_side)
{
    std::optional<Packing> packing;
    for (int side = std::min(kDefaultSide, max_side);; side = std::min(2 * side, max_side)) {
        packing = fill(task, side, 1e30);
        const bool dense = packing && task.covered(packing->density) > kDefaultFill * side * side;
        if (dense || side == max_side)
            return packing;
    }
}

}  // namespace

Packing pack(const std::vector<Rectangle>& rectangles, const AtlasOptions& options,
             std::vector<std::string>& notes)
{
    const Task one_page{rectangles, options.gutter},
        task{rectangles, options.gutter, options.pages};
    const double density = options.texels_per_metre;
    const int side = options.size > 0 ? options.size : options.max_size;
    std::optional<Packing> packing;
    if (options.size == 0 && density > 0.0)
        packing = grow_to_fit(one_page, density, options.max_size);
    else if (options.size == 0)
        packing = pack_default(one_page, options.max_size);
    if (!packing)
        packing = fill(task, side, density > 0.0 ? density : 1e30);
    if (!packing)
        throw_too_small(task, side);
    if (density > 0.0 && packing->density < density)
        notes.push_back(fmt::format("the map is limited to {}{} × {} texels: density lowered from "
                                    "{:.4g} to {:.4g} texels per metre",
                                    options.pages > 1 ? fmt::format("{} × ", options.pages) : "",
                                    side, side, density, packing->density));
    if (task.longest_side() == 0.0)  // all densities are fixed
        packing->density = task.largest_fixed();
    return *packing;
}

}  // namespace lumel
