#pragma once
// One function per subcommand, one file each. They return the exit code and throw Error.

#include "arguments.h"
#include "base/ranks/ranks.h"

namespace lumel {

/// Exit codes; documented in docs/results.md.
inline constexpr int kExitDone = 0;
inline constexpr int kExitUnexpected = 1;
inline constexpr int kExitInput = 2;
inline constexpr int kExitDevice = 3;
inline constexpr int kExitOutput = 4;

/// The page that a bake's folder holds.
std::string page_in(const std::string& folder);

/// ranks: that share the bake; null: none.
int run(const BakeArguments& arguments, Ranks* ranks = nullptr);
int run(const UpdateArguments& arguments);
int run(const RelightArguments& arguments);
int run(const WhyArguments& arguments);
int run(const MeasureArguments& arguments);
int run(const ProbesArguments& arguments);
int run(const RenderArguments& arguments);
int run(const PlayArguments& arguments);
int run(const ViewArguments& arguments);
int run(const ReferenceArguments& arguments);
int run(const InfoArguments& arguments);
int run(const CompareArguments& arguments);
int run(const ReportArguments& arguments);
int run(const DevicesArguments& arguments);
int run(const MethodsArguments& arguments);
int run(const TextArguments& arguments);

}  // namespace lumel
