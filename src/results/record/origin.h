#pragma once
// Program version and date of a file.

#include <map>
#include <string>

namespace lumel {

/// Version of this program: "0.1.0".
std::string lumel_version();

/// Versions of the libraries that light can depend on, by name.
std::map<std::string, std::string> library_versions();

/// Current time in the user's time zone, with offset: "2026-05-01T18:30:00+02:00".
std::string local_time();

}  // namespace lumel
