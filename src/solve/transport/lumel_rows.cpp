// Light from patches to lumels.
//
//   [SF17] A. Shcherbakov, V. Frolov. Accelerating Radiosity on GPUs. WSCG 2017. Section 3.6,
//   step 4.
//
// The paper leaves this open. Here the last bounce ends at the lumel, which has its own row of form
// factors, found together with those of the patches (form_factors.cpp). A row excludes close
// patches behind a wall, and a lumel in a corner differs from the middle of its patch.

#include "solve/transport/lumel_rows.h"

#include <algorithm>

#include "base/core/parallel.h"
#include "solve/matrix/half.h"

namespace lumel {
namespace {

constexpr std::size_t kRowLumelsPerTask = 256;
/// Drops factors below this fraction of an equal share of a lumel's sum, and scales up the others.
/// These are a tenth of all factors and a thousandth of the light.
constexpr float kMinShare = 0.02f;
/// Assumed fraction of patches that a lumel sees, to estimate memory.
constexpr double kSeen = 0.5;

}  // namespace

std::vector<glm::vec3> LumelRows::apply(std::span<const glm::vec3> sent) const
{
    std::vector<glm::vec3> light(size(), glm::vec3(0.0f));
    parallel_for(light.size(), kRowLumelsPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (std::uint32_t k = first[i]; k < first[i + 1]; ++k)
                light[i] += from_half(std::uint16_t(entry[k].code)) * sent[entry[k].code >> 16];
            light[i] /= kRowScale;
        }
    });
    return light;
}

LumelRowsBuilder::LumelRowsBuilder(std::size_t lumels, std::size_t patches)
    : lumels_(lumels),
      patches_(patches),
      sum_(lumels, 0.0)
{
    columns_.reserve(patches);
}

std::uint64_t LumelRowsBuilder::host_bytes(std::size_t lumels, std::size_t patches)
{
    const double each = sizeof(std::uint32_t) + sizeof(float) + sizeof(RowEntry);
    return std::uint64_t(kSeen * double(lumels) * double(patches) * each);
}

void LumelRowsBuilder::add(std::span<const float> received)
{
    const float least = kMinShare / float(patches_);
    Column& column = columns_.emplace_back();
    for (std::uint32_t i = 0; i < lumels_; ++i) {
        sum_[i] += double(received[i]);
        if (received[i] > least) {
            column.lumel.push_back(i);
            column.factor.push_back(received[i]);
        }
    }
}

LumelRows LumelRowsBuilder::finish(std::span<const char> closed)
{
    LumelRows rows;
    rows.first.assign(lumels_ + 1, 0);
    std::vector<double> kept(lumels_, 0.0);
    for (const Column& column : columns_)
        for (std::size_t k = 0; k < column.lumel.size(); ++k) {
            ++rows.first[column.lumel[k] + 1];
            kept[column.lumel[k]] += double(column.factor[k]);
        }
    for (std::size_t i = 0; i < lumels_; ++i)
        rows.first[i + 1] += rows.first[i];
    rows.entry.resize(rows.first.back());
    std::vector<std::uint32_t> next(rows.first.begin(), rows.first.end() - 1);
    for (std::uint32_t p = 0; p < columns_.size(); ++p) {
        const Column column = std::move(columns_[p]);  // frees its memory at the end of the scope
        for (std::size_t k = 0; k < column.lumel.size(); ++k) {
            const std::uint32_t i = column.lumel[k];
            const double whole = closed[i] ? 1.0 : std::min(sum_[i], 1.0);
            const float factor = float(double(column.factor[k]) * whole / kept[i]);
            rows.entry[next[i]++].code = p << 16 | to_half(kRowScale * factor);
        }
    }
    return rows;
}

}  // namespace lumel
