#include "bench/papers/page.h"

#include <array>
#include <filesystem>

#include <fmt/format.h>

namespace lumel::bench {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html xmlns="http://www.w3.org/1999/xhtml" lang="en">
<head>
<meta charset="utf-8"/>
<title>The papers' figures, made again</title>
<style>
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 75em; padding: 0 1em; }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; }
th, td { border: 1px solid #ccc; padding: 2px 8px; text-align: left; vertical-align: top; }
th { background: #f2f2f2; }
caption { text-align: left; font-weight: bold; padding: 4px 0; }
img { max-width: 100%; }
.met { background: #dff3df; } .missed.ours { background: #f8dcdc; }
.missed.paper { background: #fdf3cf; } .missed.device { background: #dfe8f8; }
p.missed { background: #f8dcdc; }
</style>
</head>
<body>
)";

constexpr const char* kColours =
    "Missed numbers have three colours: blue where the device is the cause (a processor "
    "rasterises), yellow where the paper's own scheme is, run as published, red where it is ours.";
constexpr const char* kDefaults =
    "The last column of every table is what our default method makes of the same scene with the "
    "same map: links, for glossy materials glossy, at its default quality, with its error against "
    "the same reference and its processor time; or two words that say why there is none.";
constexpr const char* kTimes =
    "Ratios of times are of wall time on a GPU, and of processor time where the device is the "
    "processor, whose wall time other work lengthens.";

std::string escaped_for_html(const std::string& text)
{
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

/// One element. Its attributes must be escaped, its content is.
std::string element(const char* name, const std::string& content,
                    const std::string& attributes = {})
{
    return fmt::format("<{}{}{}>{}</{}>", name, attributes.empty() ? "" : " ", attributes,
                       escaped_for_html(content), name);
}

template <class Texts>
std::string row_of(const char* name, const Texts& texts, const std::string& attributes = {})
{
    std::string row = attributes.empty() ? "<tr>" : "<tr " + attributes + ">";
    for (const auto& text : texts)
        row += element(name, text);
    return row + "</tr>\n";
}

std::string head_of(const std::string& caption, const std::vector<std::string>& columns)
{
    return "<table>\n" + element("caption", caption) + "\n" + row_of("th", columns);
}

/// Why a number is missed or cannot be compared.
std::string words_of_cause(Verdict verdict, Cause cause)
{
    if (verdict != Verdict::missed && verdict != Verdict::not_comparable)
        return {};
    constexpr std::array words{"", "Inherent in the paper's own scheme: ", "Physical: "};
    return words[std::size_t(cause)];
}

/// Ours beside every number of the papers.
std::string comparison_of(const Outcomes& outcomes)
{
    std::string page = head_of("Ours beside the papers' numbers: " + tally_of(outcomes),
                               {"paper", "where", "what", "paper's", "ours", "met if", "verdict",
                                "what the numbers are of", kOurDefault});
    for (const PaperValue& value : paper_values()) {
        const Judgement judgement = judge(value, outcomes);
        const std::string verdict = words_of(judgement.verdict);
        const std::string reason = judgement.reason.empty() ? "" : judgement.reason + " ";
        page += row_of("td",
                       std::array<std::string, 9>{
                           value.paper, value.place, value.quantity, value.value, judgement.ours,
                           bar_of(value), verdict,
                           reason + words_of_cause(judgement.verdict, value.cause) + value.note,
                           judgement.our_default},
                       fmt::format("class=\"{} {}\"", verdict, words_of(value.cause)));
    }
    return page + "</table>\n";
}

std::string left_out()
{
    std::string page =
        element("h2", "Not reproduced") + "\n" +
        head_of("What the papers show and no figure here makes", {"paper", "where", "what", "why"});
    for (const NotReproduced& part : not_reproduced())
        page +=
            row_of("td", std::array<std::string, 4>{part.paper, part.place, part.what, part.why});
    return page + "</table>\n";
}

std::string html_of(const std::string& line, const std::string&)
{
    return element("p", line) + "\n";
}

std::string html_of(const Table& table, const std::string&)
{
    std::string page = head_of(table.title, table.columns);
    for (const std::vector<Cell>& cells : table.rows) {
        std::vector<std::string> texts;
        for (const Cell& cell : cells)
            texts.push_back(cell.text);
        page += row_of("td", texts);
    }
    return page + "</table>\n";
}

std::string html_of(const Picture& picture, const std::string& folder)
{
    const std::string path = std::filesystem::proximate(picture.path, folder).generic_string();
    return fmt::format("<figure><img src=\"{}\" alt=\"{}\"/>{}</figure>\n", escaped_for_html(path),
                       escaped_for_html(picture.caption), element("figcaption", picture.caption));
}

std::string section_of(const Run& run, const Outcome& outcome, Extent extent,
                       const std::string& folder)
{
    std::string page = element("h2", run.title, fmt::format("id=\"{}\"", run.key)) + "\n" +
                       element("p", run.what) + "\n" +
                       element("pre", fmt::format("lumel-papers {}", run.command(extent))) + "\n" +
                       element("p", fmt::format("{:.0f} s, {:.0f} s of processor time",
                                                outcome.wall, outcome.cpu)) +
                       "\n";
    if (!outcome.failure.empty())
        page += element("p", "Failed: " + outcome.failure, "class=\"missed\"") + "\n";
    for (const Report::Part& part : outcome.report.parts())
        page += std::visit([&](const auto& shown) { return html_of(shown, folder); }, part);
    return page;
}

const char* name_of(Extent extent)
{
    switch (extent) {
    case Extent::tiny:
        return "Sizes for a test of the program: the numbers and verdicts below say nothing about "
               "any paper.";
    case Extent::full:
        return "The papers' own sizes, where we have their scenes (--full).";
    case Extent::standard:
        break;
    }
    return "Smaller sizes than the papers', as each figure's command says; --full takes their own.";
}

}  // namespace

std::string page_of(const Outcomes& outcomes, Extent extent, const std::string& folder)
{
    std::string page = kHead + element("h1", "The papers' figures, made again") + "\n" +
                       element("p", name_of(extent)) + "\n" + element("p", kTimes) + "\n" +
                       element("p", kColours) + "\n" + element("p", kDefaults) + "\n" +
                       comparison_of(outcomes) + left_out();
    for (const Run& run : all_runs())
        if (const auto outcome = outcomes.find(run.key); outcome != outcomes.end())
            page += section_of(run, outcome->second, extent, folder);
    return page + "</body>\n</html>\n";
}

std::string tally_of(const Outcomes& outcomes)
{
    constexpr std::array verdicts{Verdict::met, Verdict::missed, Verdict::not_comparable,
                                  Verdict::not_measured};
    std::array<int, verdicts.size()> counts{};
    for (const PaperValue& value : paper_values())
        ++counts[std::size_t(judge(value, outcomes).verdict)];
    std::string tally;
    for (const Verdict verdict : verdicts)
        tally += fmt::format("{}{} {}", tally.empty() ? "" : ", ", counts[std::size_t(verdict)],
                             words_of(verdict));
    return tally;
}

}  // namespace lumel::bench
