// lumel-papers: the figures of the papers that Lumel follows, made again.
//
//   [BJ04]  A. Barsi, G. Jakab. Stream Processing in Global Illumination. CESCG 2004.
//   [BSS05] A. Barsi, L. Szirmay-Kalos, G. Szijártó. Stochastic Glossy Global Illumination on
//           the GPU. 2005.
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//           Utrecht University, 2013.
//   [SF17]  A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017.
//   [TN11]  A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/core/error.h"
#include "base/core/huge_pages.h"
#include "bench/papers/all.h"
#include "bench/papers/commands.h"

namespace lumel::bench {
namespace {

constexpr int kFigureFailed = 1, kFailed = 2;  ///< exit codes

void add_all(CLI::App& app, AllSettings& settings, bool& complete)
{
    CLI::App* all = app.add_subcommand("all", "All figures, and a page of them beside the papers'");
    all->add_option("folder", settings.folder, "for papers.html and its pictures")->required();
    const auto choose = [&](const char* name, Extent extent, const char* help) {
        return all->add_flag_callback(
            name, [&settings, extent] { settings.extent = extent; }, help);
    };
    CLI::Option* full = choose("--full", Extent::full, "the papers' own sizes; takes many hours");
    choose("--tiny", Extent::tiny, "for tests: sizes that say nothing about any paper")
        ->excludes(full);
    all->add_option("--figures", settings.figures, "only these, by their names on the page")
        ->delimiter(',');
    all->callback([&] { complete = make_all(settings); });
}

int run(int argc, char** argv)
{
    Report report;
    Figures figures;
    AllSettings all;
    bool complete = true;
    CLI::App app("The papers' figures, made again");
    app.require_subcommand(1);
    add_all(app, all, complete);
    add_figures(app, figures, report);
    CLI11_PARSE(app, argc, argv);
    return complete ? 0 : kFigureFailed;
}

}  // namespace
}  // namespace lumel::bench

int main(int argc, char** argv)
{
    lumel::use_huge_pages(argv);
    try {
        return lumel::bench::run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lumel-papers: {}\n", error.what());
        return lumel::bench::kFailed;
    }
}
