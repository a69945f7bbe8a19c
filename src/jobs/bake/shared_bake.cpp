#include "jobs/bake/shared_bake.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "base/core/error.h"
#include "base/core/usage.h"
#include "jobs/solve/host_memory.h"
#include "methods/methods.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

/// Time in which a file of one machine appears on another, over a network [s]; and between looks.
constexpr double kSeenWithin = 3.0;
constexpr std::chrono::milliseconds kBetweenLooks{50};

std::string text_of(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool appears(const fs::path& file)
{
    const double start = wall_seconds();
    std::error_code ignored;
    while (!fs::exists(file, ignored)) {
        if (wall_seconds() - start > kSeenWithin)
            return false;
        std::this_thread::sleep_for(kBetweenLooks);
    }
    return true;
}

}  // namespace

void check_ranks(Ranks& ranks, const BakeOptions& options, Stages& stages)
{
    if (!std::holds_alternative<LinksOptions>(options.solver.method))
        throw Error(ErrorKind::input,
                    std::string("--solver ") + method_of(options.solver.method).id,
                    "cannot be shared by several processes, only --solver links can");
    const std::string own = bound_cores(ranks);
    const Ranks::Gathered all = ranks.all_gather(std::as_bytes(std::span(own)));
    for (std::size_t r = 0; r < ranks.count(); ++r)
        if (const std::string of_rank = text_of(all.of(r)); !of_rank.empty()) {
            stages.warn(of_rank);
            return;
        }
}

void check_folder(Ranks& ranks, const std::string& folder,
                  const std::optional<OutputFolder>& output)
{
    fs::path made;  // of a name that no other folder has
    std::string place;
    if (output) {
        made = output->path("seen-by-all-" + std::to_string(std::random_device()()));
        std::ofstream file(made);
        place = made.lexically_relative(fs::absolute(folder).lexically_normal()).string();
    }
    const Ranks::Gathered all = ranks.all_gather(std::as_bytes(std::span(place)));
    const std::vector<char> sees = ranks.all(char(appears(fs::path(folder) / text_of(all.of(0)))));
    if (output)
        fs::remove(made);
    const auto blind = std::ranges::find(sees, 0);
    if (blind != sees.end())
        throw Error(ErrorKind::output, folder,
                    "is not seen by rank " + std::to_string(blind - sees.begin()) +
                        "; the output folder must be on a file system that all machines share");
}

void agree_on_limits(Ranks& ranks, BakeOptions& options)
{
    // 0 is no limit.
    for (std::uint64_t* const limit : {&options.solver.max_bytes, &options.solver.max_device_bytes})
        *limit = std::ranges::min(ranks.all(*limit - 1)) + 1;
    if (options.solver.max_bytes > 0 && gathers_links(options))
        options.solver.max_bytes = options.solver.max_bytes / ranks.count() + 1;
}

}  // namespace lumel
