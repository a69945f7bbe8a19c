#pragma once
// The command line of the figures.

#include <string>

#include "bench/papers/figures.h"

namespace CLI {
class App;
}

namespace lumel::bench {

/// The settings of all figures.
struct Figures {
    IterationSettings iterations;
    SelectionSettings selection;
    ConvergenceSettings convergence;
    VisibilitySettings visibility;
    GlossyPicturesSettings glossy_pictures;
    AblationSettings ablation;
    FramesSettings frames;
    LayersSettings layers;
    LeakSettings leak;
    DirectionsSettings directions;
    DynamicSettings dynamic;
    DynamicSettings cross_shares;
    DriftSettings drift;
    MatrixSettings matrix;
    MatrixSpeedSettings matrix_speed;
};

/// Adds a subcommand for each, which makes it as soon as it is parsed. All must outlive the app.
void add_figures(CLI::App& app, Figures& figures, Report& report);

/// Makes one figure, given as on the command line: leak, --size, 64. Throws Error, and
/// std::logic_error for what cannot be parsed.
void run_figure(const std::vector<std::string>& arguments, Report& report);

}  // namespace lumel::bench
