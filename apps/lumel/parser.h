#pragma once
// Reads the command line by the tables of options.

#include "command.h"

namespace lumel {

/// The result of reading a command line.
struct Parsed {
    enum class Wish { command, help, version };

    Wish wish = Wish::command;
    const Command* command = nullptr;  ///< named command, or the program
};

/// Stores all values in the targets of their options, and the number of occurrences in the options.
/// Throws Error{input} with one sentence for anything that the tables do not allow.
Parsed parse(Command& program, int count, char** values);

}  // namespace lumel
