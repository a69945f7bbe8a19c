// Verdicts on numbers of the papers.

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "bench/papers/paper_values.h"
#include "bench/papers/runs.h"

namespace lumel::bench {
namespace {

PaperValue value_with(Bar bar, double limit)
{
    return {.paper = "[A]",
            .place = "Table 1",
            .quantity = "error",
            .value = "2",
            .run = "run",
            .table = "errors",
            .row = "cross, small",
            .column = "RMSE %",
            .bar = bar,
            .limit = limit,
            .note = "At rest."};
}

Outcomes outcomes_with(Cell cell)
{
    Outcomes outcomes;
    Report& report = outcomes["run"].report;
    report.table("errors", "Errors", {"technique", "scene", "RMSE %"}, "1.00 %, 2.00 s");
    report.row({"cross", "large", 9});
    report.row({"cross", "small", std::move(cell)}, "3.00 %, 4.00 s");
    return outcomes;
}

Verdict verdict_on(double ours, Bar bar, double limit)
{
    return judge(value_with(bar, limit), outcomes_with(fixed(ours, 0))).verdict;
}

TEST(Judgement, ABarIsMetOrMissedByTheNumberItself)
{
    EXPECT_EQ(verdict_on(2.0, Bar::at_most, 2.0), Verdict::met);
    EXPECT_EQ(verdict_on(2.0, Bar::at_least, 2.0), Verdict::met);
    // Both are shown as 2.
    EXPECT_EQ(verdict_on(2.1, Bar::at_most, 2.0), Verdict::missed);
    EXPECT_EQ(verdict_on(1.9, Bar::at_least, 2.0), Verdict::missed);
}

TEST(Judgement, WhatIsNoNumberIsNeverMet)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(verdict_on(nan, Bar::at_most, 2.0), Verdict::missed);
    EXPECT_EQ(verdict_on(nan, Bar::at_least, 2.0), Verdict::missed);
    const Judgement left_out = judge(value_with(Bar::at_most, 2.0), outcomes_with(none()));
    EXPECT_EQ(left_out.verdict, Verdict::not_measured);
    EXPECT_FALSE(left_out.reason.empty());
}

TEST(Judgement, OursIsShownWithoutABar)
{
    const Judgement judgement = judge(value_with(Bar::none, 0.0), outcomes_with(fixed(3.0, 1)));
    EXPECT_EQ(judgement.verdict, Verdict::not_comparable);
    EXPECT_EQ(judgement.ours, "3.0");
}

TEST(Judgement, OurDefaultIsThatOfTheRow)
{
    const auto of_row = [](const char* row) {
        PaperValue value = value_with(Bar::none, 0.0);
        value.row = row;
        return judge(value, outcomes_with(fixed(3.0, 1))).our_default;
    };
    EXPECT_EQ(of_row("cross, large"), "1.00 %, 2.00 s");
    EXPECT_EQ(of_row("cross, small"), "3.00 %, 4.00 s");
}

TEST(Judgement, AFigureThatFailedSaysWhy)
{
    Outcomes outcomes;
    outcomes["run"].failure = "out of memory";
    const Judgement judgement = judge(value_with(Bar::at_most, 2.0), outcomes);
    EXPECT_EQ(judgement.verdict, Verdict::not_measured);
    EXPECT_NE(judgement.reason.find("out of memory"), std::string::npos);
}

TEST(Judgement, EveryNumberOfThePapersSaysWhatItIsOf)
{
    for (const PaperValue& value : paper_values()) {
        EXPECT_STRNE(value.note, "") << value.quantity;
        EXPECT_TRUE(std::any_of(all_runs().begin(), all_runs().end(), [&](const bench::Run& run) {
            return std::string(run.key) == value.run;
        })) << value.quantity;
    }
}

TEST(Report, ARowThatFitsNoTableIsAMistake)
{
    Report report;
    EXPECT_THROW(report.row({1}), std::logic_error);
    report.table("errors", "Errors", {"technique", "RMSE %"}, none());
    EXPECT_THROW(report.row({"cross"}), std::logic_error);
}

}  // namespace
}  // namespace lumel::bench
