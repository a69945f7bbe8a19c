#include "results/record/origin.h"

#include <array>
#include <ctime>

#include "base/core/parallel.h"
#include "base/images/image_files.h"
#include "base/json/version.h"
#include "rays/cast/ray_scene.h"
#include "scene/gltf/unpackers.h"
#include "scene/load/webp_image.h"
#include "solve/matrix/blas.h"

namespace lumel {

std::string lumel_version()
{
    return LUMEL_VERSION;
}

std::map<std::string, std::string> library_versions()
{
    std::map<std::string, std::string> versions = {{"Draco", draco_version()},
                                                   {"Embree", embree_version()},
                                                   {"OpenEXR", openexr_version()},
                                                   {"libpng", libpng_version()},
                                                   {"libwebp", webp_version()},
                                                   {"meshoptimizer", meshoptimizer_version()},
                                                   {"nlohmann_json", json_library_version()},
                                                   {"zstd", zstd_version()},
                                                   {"oneTBB", tbb_version()}};
    if (const std::string version = blas::openblas_version(); !version.empty())
        versions["OpenBLAS"] = version;
    return versions;
}

std::string local_time()
{
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    localtime_r(&now, &parts);
    std::array<char, 40> text{};
    const std::size_t length =
        std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S%z", &parts);
    constexpr std::size_t kMinutes = 2;  // digits; ISO 8601 has a colon before them
    if (length < kMinutes)
        return {};
    const std::string_view time(text.data(), length);
    return std::string(time.substr(0, length - kMinutes)) + ':' +
           std::string(time.substr(length - kMinutes));
}

}  // namespace lumel
