#pragma once
// The files of Khronos that Lumel can read.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "../../support/source_folder.h"
#include "base/core/error.h"
#include "scene/values/scene.h"

namespace lumel::test {

inline const std::filesystem::path kConformance = support::data_path("gltf_conformance");

inline std::vector<std::string> conformance_files()
{
    std::vector<std::string> files;
    if (std::filesystem::exists(kConformance))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(kConformance))
            if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
                files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

inline std::optional<Scene> try_read(const std::string& path)
{
    try {
        return read_gltf(path);
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace lumel::test
