// Prediction: the median edge detector of LOCO-I [WSS00].

#include "results/files/half_map.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace lumel {
namespace {

constexpr int kBrightestCode = 4095;
constexpr float kCodesPerStop = 256.0f;  // steps of 0.27 %, over 16 stops
constexpr float kShareCodes = 255.0f;
/// Filtered lookups reach one texel beyond a chart, and the window of addons/three/lamp_sum.js one
/// more.
constexpr int kReach = 2;
constexpr glm::vec3 kLuxShares{0.2126f, 0.7152f, 0.0722f};  // of Rec. 709

/// Half-size irradiance, and the texels that filtered lookups of charts can reach.
struct Shrunk {
    int width, height;
    std::vector<glm::vec3> light;
    std::vector<std::uint8_t> covered, reached;
};

/// The mean of covered texels in 2 × 2, or of all if none is covered.
void shrink_texel(const Image& map, int x, int y, Shrunk& small)
{
    glm::vec3 covered(0.0f), all(0.0f);
    float covered_count = 0.0f, count = 0.0f;
    for (int v = 2 * y; v < std::min(2 * y + 2, map.height); ++v)
        for (int u = 2 * x; u < std::min(2 * x + 2, map.width); ++u) {
            const float* texel = map.at(u, v);
            const glm::vec3 light(texel[0], texel[1], texel[2]);
            all += light;
            ++count;
            if (texel[3] > 0.0f) {
                covered += light;
                ++covered_count;
            }
        }
    const std::size_t at = std::size_t(y) * std::size_t(small.width) + std::size_t(x);
    small.covered[at] = covered_count > 0.0f;
    small.light[at] = glm::max(covered_count > 0.0f ? covered / covered_count : all / count, 0.0f);
}

void mark_reached(Shrunk& small)
{
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            if (!small.covered[std::size_t(y) * std::size_t(small.width) + std::size_t(x)])
                continue;
            for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, small.height - 1); ++v)
                for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, small.width - 1);
                     ++u)
                    small.reached[std::size_t(v) * std::size_t(small.width) + std::size_t(u)] = 1;
        }
}

Shrunk shrunk(const Image& map)
{
    Shrunk small{(map.width + 1) / 2, (map.height + 1) / 2, {}, {}, {}};
    const std::size_t count = std::size_t(small.width) * std::size_t(small.height);
    small.light.resize(count);
    small.covered.resize(count);
    small.reached.resize(count);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            shrink_texel(map, x, y, small);
    mark_reached(small);
    return small;
}

int light_code(float lux, float brightest)
{
    if (!(lux > 0.0f) || !(brightest > 0.0f))
        return 0;
    const float code = float(kBrightestCode) + kCodesPerStop * std::log2(lux / brightest);
    return int(std::lround(std::clamp(code, 0.0f, float(kBrightestCode))));
}

int share_code(float part, float lux)
{
    return int(std::lround(kShareCodes * std::sqrt(std::clamp(part / lux, 0.0f, 1.0f))));
}

/// A plane of codes, stored as differences from predictions.
class PredictedPlane {
public:
    /// wide: codes of 16 bits, in two planes of bytes; otherwise of 8 bits, whose differences wrap.
    PredictedPlane(int width, int height, bool wide)
        : width_(width),
          wide_(wide),
          codes_(std::size_t(width) * std::size_t(height)),
          bytes_(codes_.size() * (wide ? 2 : 1))
    {
    }

    /// Texels must come in rows.
    void set(int x, int y, int code)
    {
        const int difference = wide_ ? code - predicted(x, y) : std::int8_t(code - predicted(x, y));
        // 0, -1, 1, -2, … become 0, 1, 2, 3, …
        const unsigned word =
            difference < 0 ? unsigned(-2 * difference - 1) : unsigned(2 * difference);
        codes_[index(x, y)] = std::int16_t(code);
        bytes_[index(x, y)] = std::uint8_t(word);
        if (wide_)
            bytes_[codes_.size() + index(x, y)] = std::uint8_t(word >> 8);
    }

    int predicted(int x, int y) const
    {
        const int left = x > 0 ? at(x - 1, y) : y > 0 ? at(x, y - 1) : 0;
        const int above = y > 0 ? at(x, y - 1) : left;
        const int corner = x > 0 && y > 0 ? at(x - 1, y - 1) : above;
        return std::clamp(left + above - corner, std::min(left, above), std::max(left, above));
    }

    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

private:
    std::size_t index(int x, int y) const
    {
        return std::size_t(y) * std::size_t(width_) + std::size_t(x);
    }
    int at(int x, int y) const { return codes_[index(x, y)]; }

    int width_;
    bool wide_;
    std::vector<std::int16_t> codes_;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace

HalfMap half_map(const Image& map)
{
    const Shrunk small = shrunk(map);
    HalfMap coded{small.width, small.height, 0.0f, {}};
    for (const glm::vec3& light : small.light)
        coded.brightest = std::max(coded.brightest, glm::dot(light, kLuxShares));
    PredictedPlane codes(small.width, small.height, true), reds(small.width, small.height, false),
        blues(small.width, small.height, false);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            const std::size_t at = std::size_t(y) * std::size_t(small.width) + std::size_t(x);
            const glm::vec3 parts = small.light[at] * kLuxShares;
            const float lux = parts.r + parts.g + parts.b;
            const int code = light_code(lux, coded.brightest);
            // A prediction costs nothing, so it stands where nothing is read.
            codes.set(x, y, small.reached[at] ? code : codes.predicted(x, y));
            const bool coloured = small.reached[at] && code > 0;
            reds.set(x, y, coloured ? share_code(parts.r, lux) : reds.predicted(x, y));
            blues.set(x, y, coloured ? share_code(parts.b, lux) : blues.predicted(x, y));
        }
    for (const PredictedPlane* plane : {&codes, &reds, &blues})
        coded.bytes.insert(coded.bytes.end(), plane->bytes().begin(), plane->bytes().end());
    return coded;
}

}  // namespace lumel
