#pragma once
// What the papers state, and how ours is judged by it.

#include <map>
#include <span>
#include <string>

#include "bench/papers/report.h"

namespace lumel::bench {

enum class Bar { at_most, at_least, none };

/// What a number that is missed, or cannot be compared, comes from.
enum class Cause {
    ours,    ///< our method, scene or setting
    paper,   ///< the paper's own method, run as published
    device,  ///< another kind of device, such as a processor without a GPU
};

/// A number of a paper, and where ours is found.
struct PaperValue {
    const char* paper;  ///< as docs/references.md names it
    const char* place;  ///< figure, table or section
    const char* quantity;
    const char* value;                       ///< as the paper states it
    const char *run, *table, *row, *column;  ///< see Run, Table and cell_at()
    Bar bar;
    double limit;  ///< of what counts as met
    /// What stands between the two numbers; why they cannot be compared, if there is no bar.
    const char* note;
    Cause cause = Cause::ours;
};

std::span<const PaperValue> paper_values();

/// What of the papers no figure makes.
struct NotReproduced {
    const char *paper, *place, *what, *why;
};

std::span<const NotReproduced> not_reproduced();

enum class Verdict { met, missed, not_comparable, not_measured };

struct Judgement {
    Verdict verdict = Verdict::not_measured;
    std::string ours;         ///< as our table has it
    std::string our_default;  ///< as its last column has it
    std::string reason;       ///< why nothing was measured
};

/// What became of one run.
struct Outcome {
    Report report;
    std::string failure;           ///< what went wrong; empty: nothing
    double wall = 0.0, cpu = 0.0;  ///< [s]
};

/// By the keys of runs. A number that is none is never met.
using Outcomes = std::map<std::string, Outcome>;
Judgement judge(const PaperValue& value, const Outcomes& outcomes);

std::string words_of(Verdict verdict);        ///< "met", "not measured"
std::string words_of(Cause cause);            ///< "ours", "paper", "device"
std::string bar_of(const PaperValue& value);  ///< "at most 1.25"; empty without a bar

}  // namespace lumel::bench
