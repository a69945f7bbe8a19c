#pragma once
// What made a file, and when.

#include <map>
#include <string>

namespace lumel {

/// Of this program: "0.1.0".
std::string lumel_version();

/// Versions of the libraries that light may depend on, by name.
std::map<std::string, std::string> library_versions();

/// Now, in the user's time zone, with its offset: "2026-05-01T18:30:00+02:00".
std::string local_time();

}  // namespace lumel
