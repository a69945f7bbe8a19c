#pragma once
// The one form in which JSON is written, and files of it.

#include <string>

#include "base/json/json_view.h"

namespace lumel {

/// The text of a document: members in their order, indented by two, a line break at the end. Bytes
/// that are not UTF-8, which file names may hold, are replaced; infinity and NaN become null.
std::string json_text(const Json& json);

/// The same as a file. Throws Error{output}.
void write_json(const std::string& path, const Json& json);

/// Throws Error{input} for a file that cannot be read, and with line and column for broken JSON.
Json read_json(const std::string& path);

/// The number with the fewest digits that is `value` once it is a float again.
double shortest(float value);

}  // namespace lumel
