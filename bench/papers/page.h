#pragma once
// papers.html: ours beside the papers' numbers.

#include <string>

#include "bench/papers/paper_values.h"
#include "bench/papers/runs.h"

namespace lumel::bench {

/// The whole page, well-formed XML, of what has been made so far. Pictures are linked relative to
/// `folder`, in which the page lies.
std::string page_of(const Outcomes& outcomes, Extent extent, const std::string& folder);

/// How many of the papers' numbers have each verdict: "31 met, 20 missed, …".
std::string tally_of(const Outcomes& outcomes);

}  // namespace lumel::bench
