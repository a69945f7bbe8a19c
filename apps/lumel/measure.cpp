// lumel measure: the light of a bake in lux.

#include <algorithm>

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {
namespace {

/// Points that are listed; --csv and --json have all.
constexpr std::size_t kMeasuredRows = 24;
constexpr double kPercent = 100.0;

/// A value, rounded to the digits that its noise leaves significant.
std::string lux_text(double lux)
{
    return fmt::format("{:.4g}", lux);
}

std::string line_of(const MeasureSummary& summary, const MeasureRow& row)
{
    const glm::dvec3 &at = row.point.place, &n = row.point.normal;
    std::string line = fmt::format("{:9.3f} {:9.3f} {:9.3f}  {:5.2f} {:5.2f} {:5.2f}", at.x, at.y,
                                   at.z, n.x, n.y, n.z);
    const Reading& reading = row.reading;
    if (reading.inside)
        return line + "  inside of a surface\n";
    line += fmt::format("  {:>10} ± {:<8}", lux_text(reading.lux),
                        fmt::format("{:.2g}", reading.noise));
    if (const auto factor = daylight_factor(summary, row))
        line += fmt::format("  {:7.2f} %", kPercent * *factor);
    if (row.daylight)
        line += fmt::format("  {:5.1f} %  {:5.1f} %", kPercent * row.daylight->autonomy,
                            kPercent * (row.daylight->useful[1] + row.daylight->useful[2]));
    if (row.daylight && row.daylight->hour)
        line += fmt::format("  {:>10} ± {:.2g}", lux_text(row.daylight->hour->lux),
                            row.daylight->hour->noise);
    return line + "\n";
}

std::string list_of(const MeasureSummary& summary)
{
    if (summary.rows.empty())
        return {};
    std::string text = "place [m]                      facing             illuminance [lx]";
    if (summary.outdoors || summary.year)
        text += "        daylight";
    if (summary.year)
        text += fmt::format("  {:g} lx     useful", summary.year->target);
    if (summary.rows.front().daylight && summary.rows.front().daylight->hour)
        text += "   that hour [lx]";
    text += "\n";
    const std::size_t count = std::min(summary.rows.size(), kMeasuredRows);
    for (std::size_t i = 0; i < count; ++i)
        text += line_of(summary, summary.rows[i]);
    if (count < summary.rows.size())
        text += fmt::format("{} more points: --csv FILE writes all\n", summary.rows.size() - count);
    return text;
}

std::string year_of(const MeasuredYear& year)
{
    const DaylightFigures& figures = year.figures;
    if (figures.count == 0)
        return "daylight over the year: no figures, as all points are outdoors; see --bounds";
    std::string text = fmt::format(
        "daylight over the year: mean daylight factor {:.2f} %; sDA {:g} lx, {:g} % of {} hours: "
        "{:.1f} % of the points; useful daylight (UDI, 100 to 3000 lx): {:.1f} % of the hours",
        kPercent * figures.factor, year.target, kPercent * kSufficientHours, year.hours,
        kPercent * figures.sufficient, kPercent * figures.useful);
    if (figures.outdoors > 0)
        text += fmt::format("\nleft out of these: {} outdoors; see --bounds",
                            figures.outdoors == 1
                                ? "1 point that is"
                                : fmt::format("{} points that are", figures.outdoors));
    return text;
}

std::string plane_of(const MeasureSummary& summary)
{
    const PlaneFigures& figures = summary.figures;
    const std::size_t left_out = summary.rows.size() - figures.count;
    const std::string inside =
        left_out > 0 ? fmt::format(", {} inside of things left out", left_out) : std::string();
    std::string text =
        fmt::format("plane at {:g} m, {} points {:g} m apart{}: ", summary.plane->height,
                    figures.count, summary.plane->spacing, inside);
    if (figures.count == 0)
        return text + "nothing to measure";
    text += fmt::format("minimum {} lx, mean {} lx (± {:.2g}), maximum {} lx, uniformity {:.3f}",
                        lux_text(figures.least), lux_text(figures.mean), figures.noise_of_mean,
                        lux_text(figures.most), figures.uniformity);
    if (summary.year)
        text += "\n" + year_of(*summary.year);
    else if (summary.outdoors)
        text += fmt::format("; mean daylight factor {:.2f} %",
                            kPercent * figures.mean / *summary.outdoors);
    return text;
}

std::string printed(const MeasureSummary& summary)
{
    std::string text = list_of(summary);
    if (summary.plane)
        text += plane_of(summary);
    for (const std::string& note : summary.notes)
        text += (text.empty() || text.ends_with('\n') ? "" : "\n") + note;
    if (text.ends_with('\n'))
        text.pop_back();
    return text;
}

}  // namespace

int run(const MeasureArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const MeasureSummary summary = measure(arguments.folder, arguments.options, progress);
        return Conclusion{summary.report, printed(summary), false};
    };
    return do_long_work(arguments.talk, 0, work);
}

}  // namespace lumel
