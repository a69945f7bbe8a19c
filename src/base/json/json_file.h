#pragma once
// JSON text and files in one format.

#include <string>

#include <glm/glm.hpp>

#include "base/json/json_view.h"

namespace lumel {

/// Text of a document: members in their order, indented by two, with a final line break. Replaces
/// bytes that are not UTF-8, which file names may have; infinity and NaN become null.
std::string json_text(const Json& json);

/// Writes that text to a file. Throws Error{output}.
void write_json(const std::string& path, const Json& json);
/// On one line, for long lists of numbers.
void write_compact_json(const std::string& path, const Json& json);

/// Reads a file. Throws Error{input} if it is unreadable, and with line and column for broken JSON.
Json read_json(const std::string& path);

/// [x, y, z]
inline Json json_array(const glm::dvec3& v)
{
    return Json::array({v.x, v.y, v.z});
}

/// The number with the fewest digits that rounds to `value` as a float.
double shortest(float value);

}  // namespace lumel
