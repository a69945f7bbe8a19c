#pragma once
// Maps of a bake's folder, with all their pages.

#include <string>

#include "atlas/packing/pages.h"
#include "base/core/image.h"
#include "base/json/json_file.h"

namespace lumel {

/// Pages of the maps of a folder, of unknown side. report: its report.json. Throws Error{input}.
Pages pages_in(const std::string& folder, const Json& report);

/// All pages of a map, arranged as in Pages. name: as in page_name(). Throws Error{input}.
Image whole_map(const std::string& folder, const Pages& pages, const std::string& name);

}  // namespace lumel
