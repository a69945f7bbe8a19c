#pragma once
// Where the tests find files that they do not make themselves.

#include <string>

namespace lumel::support {

/// A file or folder of the source tree.
std::string source_path(const std::string& name);

/// A file or folder of the test data beside the source tree, which may be absent.
std::string data_path(const std::string& name);

}  // namespace lumel::support
