#pragma once
// The commands as the parser knows them: each in a file of its own, NAME_options.cpp.

#include <functional>

#include "arguments.h"

namespace CLI {
class App;
}

namespace lumel {

/// A command of the program.
struct Command {
    CLI::App* parser;
    /// What was given to it, once it has been parsed. Throws Error{input} for what cannot be.
    std::function<Arguments()> arguments;
};

// Each adds its command to the program.

Command bake_command(CLI::App& program);
Command update_command(CLI::App& program);
Command relight_command(CLI::App& program);
Command why_command(CLI::App& program);
Command measure_command(CLI::App& program);
Command probes_command(CLI::App& program);
Command render_command(CLI::App& program);
Command play_command(CLI::App& program);
Command view_command(CLI::App& program);
Command reference_command(CLI::App& program);
Command info_command(CLI::App& program);
Command compare_command(CLI::App& program);
Command report_command(CLI::App& program);
Command devices_command(CLI::App& program);
Command methods_command(CLI::App& program);
/// Of what the program says of itself.
Command help_command(CLI::App& program);
Command man_command(CLI::App& program);
Command completion_command(CLI::App& program);
Command options_command(CLI::App& program);

}  // namespace lumel
