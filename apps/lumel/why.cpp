// lumel why: who sends light to a place in the lightmap.

#include <algorithm>

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {
namespace {

/// Senders and names that are listed; --json has all.
constexpr std::size_t kWhyRows = 12, kNames = 6;

std::string place_of(const WhyRow& row)
{
    return row.place ? fmt::format("{:7.2f} {:7.2f} {:7.2f}  {:8.2f}", row.place->x, row.place->y,
                                   row.place->z, row.distance)
                     : std::string();
}

std::string head_of(const WhySummary& summary)
{
    return fmt::format(
        "{}column {}, row {}: \"{}\" at {:.2f} {:.2f} {:.2f} m gets {:.4g} {:.4g} {:.4g} lx "
        "(rays find {:.4g} {:.4g} {:.4g})\n",
        summary.page > 0 ? fmt::format("page {}, ", summary.page) : "", summary.texel.x,
        summary.texel.y, summary.instance, summary.place.x, summary.place.y, summary.place.z,
        summary.solved.r, summary.solved.g, summary.solved.b, summary.found.r, summary.found.g,
        summary.found.b);
}

/// Widest text of a column.
template <class Text>
std::size_t width_of(const WhySummary& summary, std::size_t count, std::size_t least, Text text)
{
    for (std::size_t i = 0; i < count; ++i)
        least = std::max(least, text(summary.rows[i]).size());
    return least;
}

std::string table_of(const WhySummary& summary)
{
    std::string table = head_of(summary);
    if (!summary.remark.empty())
        table += summary.remark + "\n";
    if (summary.rows.empty())
        return table + "no light arrives there";
    const std::size_t count = std::min(summary.rows.size(), kWhyRows);
    const auto name = [](const WhyRow& row) { return row.name; };
    const auto material = [](const WhyRow& row) { return row.material; };
    const std::size_t names = width_of(summary, count, 4, name);
    const std::size_t materials = width_of(summary, count, 8, material);
    table += fmt::format(" share  {:<{}}  {:<{}}  place [m]                distance [m]\n", "from",
                         names, "material", materials);
    double rest = 1.0;
    for (std::size_t i = 0; i < count; ++i) {
        const WhyRow& row = summary.rows[i];
        rest -= row.share;
        table += fmt::format("{:5.1f}%  {:<{}}  {:<{}}  {}\n", 100.0 * row.share, row.name, names,
                             row.material, materials, place_of(row));
    }
    if (summary.rows.size() > count)
        table +=
            fmt::format("{:5.1f}%  {} more places\n", 100.0 * rest, summary.rows.size() - count);
    table += "in all:";
    for (std::size_t i = 0; i < std::min(summary.by_name.size(), kNames); ++i)
        table += fmt::format("{} {} {:.1f} %", i > 0 ? "," : "", summary.by_name[i].first,
                             100.0 * summary.by_name[i].second);
    return table;
}

}  // namespace

int run(const WhyArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const WhySummary summary = why(arguments.folder, arguments.options, progress);
        return Conclusion{summary.report, table_of(summary), false};
    };
    return do_long_work(arguments.talk, 0, work);
}

}  // namespace lumel
