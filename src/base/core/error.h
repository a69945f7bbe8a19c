#pragma once
// The one exception of Lumel: a sentence its reader can act on.

#include <stdexcept>
#include <string>

namespace lumel {

/// Why an operation ended, as it decides the exit code of the command line.
enum class ErrorKind {
    input,    ///< a file, option or scene is not as it must be (exit code 2)
    device,   ///< no usable GPU, out of memory, device lost (exit code 3)
    output,   ///< a result cannot be written (exit code 4)
    stopped,  ///< the caller wanted it to end before there was a result (128 + the signal)
};

/// "where: what is wrong; what to do". `where` is a file, or a file and the place in it
/// (a JSON pointer such as /meshes/0/primitives/1), or empty.
/// It is one line: control characters of a file's text become spaces.
class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& where, const std::string& what);

    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

}  // namespace lumel
