#pragma once
// scene.lumelmat: a Relightable on disk. See matrix_file.cpp.

#include <string>

#include "methods/matrix/relightable.h"

namespace lumel {

inline constexpr const char* kMatrixFile = "scene.lumelmat";

/// Direct light is stored as half floats, everything else in full. Throws Error{output}.
void write_relightable(const std::string& path, const Relightable& light);

/// Reads the whole file. Throws Error{input} if it is missing, damaged, or of another version.
Relightable read_relightable(const std::string& path);

}  // namespace lumel
