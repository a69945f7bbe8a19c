#include "progress_lines.h"

#include <algorithm>

#include <fmt/core.h>

#include "base/json/json_file.h"

namespace lumel {
namespace {

constexpr auto kEvery = std::chrono::milliseconds(100);

}  // namespace

std::string progress_json(const BakeProgress& progress)
{
    Json json = {{"stage", progress.stage},
                 {"fraction", shortest(float(std::clamp(progress.fraction, 0.0, 1.0)))}};
    if (progress.shots > 0)
        json["shots"] = progress.shots;
    if (progress.error >= 0.0)
        json["error"] = shortest(float(progress.error));
    json["seconds"] = shortest(float(progress.seconds));
    return json.dump();
}

void ProgressLines::show(const BakeProgress& progress)
{
    const auto now = std::chrono::steady_clock::now();
    if (progress.stage == stage_ && now - last_ < kEvery)
        return;
    fmt::print(stderr, "{}\n", progress_json(progress));
    std::fflush(stderr);
    stage_ = progress.stage;
    last_ = now;
}

}  // namespace lumel
