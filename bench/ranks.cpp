// What a bake would take on many machines: predicted from the reports of two bakes of one scene, by
// one process and by several.
//
// Work is what every rank repeats plus what all share; the two reports give both. Traffic is what a
// rank receives when all ranks exchange everything (all-gather). Work and traffic grow with the
// number of lumels, messages do not.

#include "bench/modes.h"

#include <array>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/json/json_file.h"

namespace lumel::bench {
namespace {

constexpr double kMost = 1e18;                ///< of any number in a report
constexpr double kMessage = 20e-6;            ///< latency of an exchange in a fast network [s]
constexpr double kGigabit = 1e9 / 8.;         ///< [bytes/s]
constexpr std::array kNetworks{10.0, 100.0};  ///< [Gbit/s]
constexpr std::array kLumels{1e6, 1e7, 1e8, 1e9};
constexpr std::array kRanks{1.0, 4.0, 16.0, 64.0, 256.0, 1000.0};

struct Measured {
    double lumels, ranks;
    double work;      ///< of one rank [CPU s]
    double memory;    ///< of one rank [bytes]
    double received;  ///< by one rank [bytes]
    double messages;
};

/// The rank that wrote the report.
Measured read_bake(const std::string& path)
{
    const Json json = read_json(path);
    const JsonView report(path, json);
    const auto number = [](const JsonView& at, const char* key) {
        return at.get(key).number(0.0, kMost);
    };
    Measured bake{.lumels = number(report.get("sizes"), "lumels"),
                  .ranks = 1.0,
                  .work = number(report.get("timings"), "cpu_seconds"),
                  .memory = number(report.get("memory"), "peak_host_bytes"),
                  .received = 0.0,
                  .messages = 0.0};
    if (const std::optional<JsonView> ranks = report.find("ranks")) {
        bake.ranks = double(report.count("ranks"));
        bake.received = number(ranks->at(0), "received_bytes");
        bake.messages = number(ranks->at(0), "messages");
    }
    return bake;
}

/// What each rank has of its own beside its part of what is divided, per lumel.
struct Cost {
    double repeated, divided;

    /// From what one process has, and one of `ranks`.
    Cost(double one, double of_several, double ranks, double lumels)
        : repeated((ranks * of_several - one) / (ranks - 1.0) / lumels),
          divided((one - of_several) * ranks / (ranks - 1.0) / lumels)
    {
    }
    double of_rank(double lumels, double ranks) const
    {
        return lumels * (repeated + divided / ranks);
    }
};

}  // namespace

void predict_ranks(const Settings& settings)
{
    if (settings.ranks.size() != 2)
        throw Error(ErrorKind::input, "--ranks",
                    "takes two reports: of a bake by one process, and by several");
    const Measured one = read_bake(settings.ranks[0]), several = read_bake(settings.ranks[1]);
    if (one.ranks != 1.0 || several.ranks < 2.0 || one.lumels != several.lumels)
        throw Error(ErrorKind::input, "--ranks",
                    "takes reports of the same bake, the first by one process, the second by "
                    "several");
    const Cost work(one.work, several.work, several.ranks, one.lumels);
    const Cost memory(one.memory, several.memory, several.ranks, one.lumels);
    const double share = 1.0 - 1.0 / several.ranks;  // of all, that a rank receives
    const double traffic = several.received / share / one.lumels;
    fmt::print("{:.0f} lumels: one process {:.1f} CPU s, {:.0f} MB; one of {:.0f} ranks {:.1f} "
               "CPU s, {:.0f} MB, received {:.0f} MB in {:.0f} messages\n",
               one.lumels, one.work, 1e-6 * one.memory, several.ranks, several.work,
               1e-6 * several.memory, 1e-6 * several.received, several.messages);
    fmt::print("a lumel: {:.1f} µs on every rank, {:.1f} µs divided, {:.0f} bytes exchanged\n",
               1e6 * work.repeated, 1e6 * work.divided, traffic);
    fmt::print("\nmachines of {} cores; time [s] and efficiency by the network\n\n",
               settings.cores);
    fmt::print("{:>8} {:>6} {:>10} {:>9}", "lumels", "ranks", "GB a rank", "work");
    for (const double network : kNetworks)
        fmt::print(" {:>9.0f} Gbit/s {:>6}", network, "");
    fmt::print("\n");
    for (const double lumels : kLumels) {
        const double alone = work.of_rank(lumels, 1.0) / settings.cores;
        for (const double ranks : kRanks) {
            const double working = work.of_rank(lumels, ranks) / settings.cores;
            fmt::print("{:>8.0e} {:>6.0f} {:>10.1f} {:>9.1f}", lumels, ranks,
                       1e-9 * memory.of_rank(lumels, ranks), working);
            for (const double network : kNetworks) {
                const double exchanged =
                    ranks == 1.0 ? 0.0
                                 : traffic * lumels * (1.0 - 1.0 / ranks) / (network * kGigabit) +
                                       several.messages * kMessage;
                const double whole = working + exchanged;
                fmt::print(" {:>16.1f} {:>4.0f} %", whole, 100.0 * alone / (ranks * whole));
            }
            fmt::print("\n");
        }
    }
}

}  // namespace lumel::bench
