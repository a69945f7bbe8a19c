#pragma once
// A bake by several ranks: what they check and agree on before they share the work.

#include <optional>
#include <string>

#include "base/ranks/ranks.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "results/files/folder.h"

namespace lumel {

/// Throws Error{input} for methods that ranks cannot share. Warns if ranks are bound to few cores.
void check_ranks(Ranks& ranks, const BakeOptions& options, Stages& stages);

/// Throws Error{output} unless all ranks see the output folder. output: of the first rank.
void check_folder(Ranks& ranks, const std::string& folder,
                  const std::optional<OutputFolder>& output);

/// Makes limits of memory common.
void agree_on_limits(Ranks& ranks, BakeOptions& options);

}  // namespace lumel
