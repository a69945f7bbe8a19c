#pragma once
// The exception of Lumel: a sentence that its reader can act on.

#include <stdexcept>
#include <string>

namespace lumel {

/// Cause of an error; determines the exit code of the command line.
enum class ErrorKind {
    input,    ///< invalid file, option or scene (exit code 2)
    device,   ///< no usable GPU, out of memory, device lost (exit code 3)
    output,   ///< a result cannot be written (exit code 4)
    stopped,  ///< stopped by the caller before there was a result (128 + the signal)
};

/// "where: fault; remedy". `where` is a file, a file and a location in it (a JSON pointer such as
/// /meshes/0/primitives/1), or empty. The message is one line: control characters become spaces.
class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& where, const std::string& what);

    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

}  // namespace lumel
