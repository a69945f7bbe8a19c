#include "links/filter/fit_level.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Radius of a fit [cells]: 2.5 deviations, where weights fall to 4 %.
constexpr int kFitReach = 3;
constexpr float kFitRadius = 2.5f * kFitSpread;
constexpr int kFitSide = 2 * kFitReach + 1;
constexpr std::size_t kMaxTaps = std::size_t(kFitSide) * kFitSide;
/// Ridge of linear and of quadratic terms, relative to the sum of weights: keeps fits of cells in a
/// row solvable.
constexpr float kLinearRidge = 1e-3f, kQuadraticRidge = 3e-3f;
/// Minimum cells of a quadratic and of a linear fit.
constexpr std::size_t kMinQuadratic = 14, kMinLinear = 6;
/// Normals of mixed cells differ by less than 25 degrees.
const float kCosFitted = std::cos(glm::radians(25.0f));
/// Normals of neighbours in an even window differ by less than 3 degrees.
const float kCosEven = std::cos(glm::radians(3.0f));
/// Cells per task.
constexpr std::size_t kCellsPerTask = 1024;

using Terms = std::array<float, kFitTerms>;

Terms terms_at(const glm::vec2& at)
{
    const float u = at.x / kFitSpread, v = at.y / kFitSpread;
    return {1.0f, u, v, u * u, u * v, v * v};
}

/// A cell of a fit.
struct FitTap {
    std::ptrdiff_t to;  ///< its index, relative to the centre's
    glm::vec2 place;    ///< [cells]
    float weight;
};

struct FitWindow {
    std::array<FitTap, kMaxTaps> taps;
    std::size_t count = 0;
};

/// Factors of the light of each cell in the terms of a fit.
struct FitKernel {
    std::array<std::array<float, kMaxTaps>, kFitTerms> of_term;
};

/// Symmetric positive definite matrix as L Lᵀ.
class Cholesky {
public:
    Cholesky(const std::array<Terms, kFitTerms>& matrix, std::size_t size) : size_(size)
    {
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                float sum = matrix[i][j];
                for (std::size_t k = 0; k < j; ++k)
                    sum -= lower_[i][k] * lower_[j][k];
                lower_[i][j] = i == j ? std::sqrt(sum) : sum / lower_[j][j];
            }
    }

    void solve(Terms& right) const
    {
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t k = 0; k < i; ++k)
                right[i] -= lower_[i][k] * right[k];
            right[i] /= lower_[i][i];
        }
        for (std::size_t i = size_; i-- > 0;) {
            for (std::size_t k = i + 1; k < size_; ++k)
                right[i] -= lower_[k][i] * right[k];
            right[i] /= lower_[i][i];
        }
    }

private:
    std::size_t size_;
    std::array<Terms, kFitTerms> lower_{};
};

/// Weighted least squares over a window, for the first `rows` terms. A term's factors are
/// e_rᵀ A⁻¹ b_t w_t, with A = Σ w b bᵀ.
FitKernel kernel_of(const FitWindow& window, std::size_t rows)
{
    const std::size_t size = window.count >= kMinQuadratic ? kFitTerms
                             : window.count >= kMinLinear  ? 3
                                                           : 1;
    std::array<Terms, kMaxTaps> terms;
    std::array<Terms, kFitTerms> matrix{};
    for (std::size_t t = 0; t < window.count; ++t) {
        terms[t] = terms_at(window.taps[t].place);
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                matrix[i][j] += window.taps[t].weight * terms[t][i] * terms[t][j];
    }
    const float sum = matrix[0][0];
    for (std::size_t i = 1; i < size; ++i)
        matrix[i][i] += sum * (i < 3 ? kLinearRidge : kQuadraticRidge);
    const Cholesky factors(matrix, size);
    FitKernel kernel;
    for (std::size_t r = 0; r < rows; ++r) {
        Terms row{};
        if (r < size) {
            row[r] = 1.0f;
            factors.solve(row);
        }
        for (std::size_t t = 0; t < window.count; ++t) {
            float factor = 0.0f;
            for (std::size_t i = 0; i < size; ++i)
                factor += row[i] * terms[t][i];
            kernel.of_term[r][t] = window.taps[t].weight * factor;
        }
    }
    return kernel;
}

float weight_at(const glm::vec2& place)
{
    return std::exp(-0.5f * glm::dot(place, place) / (kFitSpread * kFitSpread));
}

bool is_within_fit(int dx, int dy)
{
    return float(dx * dx + dy * dy) <= kFitRadius * kFitRadius;
}

/// Cells around a cell that open steps lead to, along a straight way.
template <std::size_t Count>
FitWindow window_at(const FitLevel<Count>& level, int x, int y)
{
    FitWindow window;
    std::array<char, kMaxTaps> reached{};
    const auto place = [](int dx, int dy) {
        return std::size_t(dy + kFitReach) * kFitSide + std::size_t(dx + kFitReach);
    };
    const std::size_t centre = level.at(x, y);
    const auto add = [&](int dx, int dy) {
        const std::size_t cell = level.at(x + dx, y + dy);
        reached[place(dx, dy)] = 1;
        const glm::vec2 at = glm::vec2(dx, dy) + level.centroid[cell];
        window.taps[window.count++] = {std::ptrdiff_t(cell) - std::ptrdiff_t(centre), at,
                                       level.count[cell] * weight_at(at)};
    };
    add(0, 0);
    const auto sign = [](int a) { return (a > 0) - (a < 0); };
    for (int ring = 1; ring <= kFitReach; ++ring)
        for (int dy = -ring; dy <= ring; ++dy)
            for (int dx = -ring; dx <= ring; ++dx) {
                if (std::max(std::abs(dx), std::abs(dy)) != ring || !is_within_fit(dx, dy) ||
                    !level.contains(x + dx, y + dy))
                    continue;
                const int last_x = std::abs(dx) == ring ? sign(dx) : 0,
                          last_y = std::abs(dy) == ring ? sign(dy) : 0;
                const int from_x = dx - last_x, from_y = dy - last_y;
                if (reached[place(from_x, from_y)] &&
                    level.is_open(x + from_x, y + from_y, last_x, last_y) &&
                    glm::dot(level.normal[centre], level.normal[level.at(x + dx, y + dy)]) >=
                        kCosFitted)
                    add(dx, dy);
            }
    return window;
}

/// The window of a cell among full ones.
FitWindow even_window(int width)
{
    FitWindow window;
    for (int dy = -kFitReach; dy <= kFitReach; ++dy)
        for (int dx = -kFitReach; dx <= kFitReach; ++dx)
            if (is_within_fit(dx, dy))
                window.taps[window.count++] = {std::ptrdiff_t(dy) * width + dx, glm::vec2(dx, dy),
                                               weight_at(glm::vec2(dx, dy))};
    return window;
}

/// Distance of each cell from the nearest that is not full, flat and open on all sides, in steps of
/// a king, up to kFitReach + 1.
template <std::size_t Count>
std::vector<std::uint8_t> distance_to_uneven(const FitLevel<Count>& level)
{
    std::vector<std::uint8_t> distance(level.count.size(), 0);
    const float full = float(level.side * level.side);
    const auto is_even = [&](int x, int y) {
        const std::size_t cell = level.at(x, y);
        if (x == 0 || y == 0 || x + 1 == level.width || y + 1 == level.height ||
            level.count[cell] != full || level.is_split[cell] || level.steps[cell] != 0xFu)
            return false;
        return glm::dot(level.normal[cell], level.normal[level.at(x + 1, y)]) >= kCosEven &&
               glm::dot(level.normal[cell], level.normal[level.at(x, y + 1)]) >= kCosEven;
    };
    const auto lower = [&](int x, int y, int dx, int dy) {
        std::uint8_t& own = distance[level.at(x, y)];
        own = std::min(own, std::uint8_t(distance[level.at(x + dx, y + dy)] + 1));
    };
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x)
            if (is_even(x, y)) {
                distance[level.at(x, y)] = kFitReach + 1;
                for (const Offset& step : kSteps)
                    lower(x, y, -step.x, -step.y);
            }
    for (int y = level.height - 1; y >= 0; --y)
        for (int x = level.width - 1; x >= 0; --x)
            if (distance[level.at(x, y)] > 0)
                for (const Offset& step : kSteps)
                    lower(x, y, step.x, step.y);
    return distance;
}

template <std::size_t Count>
void add_scaled(FitLight<Count>& sum, float factor, const FitLight<Count>& light)
{
    for (std::size_t c = 0; c < light.size(); ++c)
        sum[c] += factor * light[c];
}

/// Fits of all cells [cells][rows]: their first `rows` terms.
template <std::size_t Count>
std::vector<FitLight<Count>> fit_all(const FitLevel<Count>& level, std::size_t rows)
{
    const std::vector<std::uint8_t> distance = distance_to_uneven(level);
    FitWindow even;
    FitKernel of_even;
    if (*std::max_element(distance.begin(), distance.end()) > kFitReach) {
        even = even_window(level.width);
        of_even = kernel_of(even, rows);
    }
    std::vector<FitLight<Count>> fits(level.count.size() * rows);
    const auto fit = [&](int x, int y) {
        const std::size_t cell = level.at(x, y);
        if (!level.counts(cell))
            return;
        std::optional<FitWindow> own;
        std::optional<FitKernel> of_own;
        if (distance[cell] <= kFitReach) {
            own = window_at(level, x, y);
            of_own = kernel_of(*own, rows);
        }
        const FitWindow& window = own ? *own : even;
        const FitKernel& kernel = of_own ? *of_own : of_even;
        for (std::size_t r = 0; r < rows; ++r) {
            FitLight<Count> sum{};
            for (std::size_t t = 0; t < window.count; ++t)
                add_scaled<Count>(
                    sum, kernel.of_term[r][t],
                    level.light[std::size_t(std::ptrdiff_t(cell) + window.taps[t].to)]);
            fits[cell * rows + r] = sum;
        }
    };
    parallel_for(std::size_t(level.height), kCellsPerTask / std::size_t(level.width) + 1,
                 [&](std::size_t first, std::size_t last) {
                     for (int y = int(first); y < int(last); ++y)
                         for (int x = 0; x < level.width; ++x)
                             fit(x, y);
                 });
    return fits;
}

/// Averages the four cells of a cell.
template <std::size_t Count>
void average(const FitLevel<Count>& fine, int x, int y, FitLevel<Count>& level)
{
    const std::size_t cell = level.at(x, y);
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            if (!fine.contains(2 * x + dx, 2 * y + dy))
                continue;
            const std::size_t from = fine.at(2 * x + dx, 2 * y + dy);
            const float count = fine.count[from];
            level.count[cell] += count;
            level.centroid[cell] += count * 0.5f * (fine.centroid[from] + glm::vec2(dx, dy) - 0.5f);
            level.normal[cell] += count * fine.normal[from];
            add_scaled<Count>(level.light[cell], count, fine.light[from]);
        }
    const float count = std::max(level.count[cell], 1.0f);
    level.centroid[cell] /= count;
    for (float& channel : level.light[cell])
        channel /= count;
    const float length = glm::length(level.normal[cell]);
    if (length > 0.0f)
        level.normal[cell] /= length;
}

/// Of neighbouring cells: is there a pair across their border, and are the steps of all open?
template <std::size_t Count>
class Border {
public:
    explicit Border(const FitLevel<Count>& fine) : fine_(&fine) {}

    void cross(int x, int y, int dx, int dy)
    {
        const auto is = [&](int at_x, int at_y) {
            return fine_->contains(at_x, at_y) && fine_->counts(fine_->at(at_x, at_y));
        };
        if (is(x, y) && is(x + dx, y + dy)) {
            any_ = true;
            all_ = all_ && fine_->is_open(x, y, dx, dy);
        }
    }
    bool is_shut() const { return !all_; }
    bool is_open() const { return any_ && all_; }

private:
    const FitLevel<Count>* fine_;
    bool any_ = false, all_ = true;
};

/// Finds the steps of a cell, and whether geometry splits it.
template <std::size_t Count>
void find_borders(const FitLevel<Count>& fine, int x, int y, FitLevel<Count>& level)
{
    const int left = 2 * x, top = 2 * y;
    Border<Count> within(fine), right(fine), below(fine), down_right(fine), down_left(fine);
    for (int n = 0; n < 2; ++n) {
        within.cross(left, top + n, 1, 0);
        within.cross(left + n, top, 0, 1);
        right.cross(left + 1, top + n, 1, 0);
        below.cross(left + n, top + 1, 0, 1);
    }
    down_right.cross(left + 1, top + 1, 1, 1);
    down_left.cross(left, top + 1, -1, 1);
    const std::size_t cell = level.at(x, y);
    level.is_split[cell] = within.is_shut() ? 1 : 0;
    for (int n = 0; n < 4; ++n)
        if (fine.contains(left + n % 2, top + n / 2) &&
            fine.is_split[fine.at(left + n % 2, top + n / 2)])
            level.is_split[cell] = 1;
    unsigned steps = 0;
    for (unsigned s = 0; const Border<Count>* border : {&right, &below, &down_right, &down_left})
        steps |= (border->is_open() ? 1u : 0u) << s++;
    level.steps[cell] = std::uint8_t(steps);
}

}  // namespace

template <std::size_t Count>
bool FitLevel<Count>::is_open(int x, int y, int dx, int dy) const
{
    if (dx == 0 && dy == 0)
        return true;
    if (!contains(x + dx, y + dy) || !counts(at(x + dx, y + dy)))
        return false;
    return has_step(steps, at(x, y), at(x + dx, y + dy), dx, dy);
}

template <std::size_t Count>
FitLevel<Count> finest_level(const FilterChart& chart,
                             const std::array<const Estimates*, Count>& found)
{
    FitLevel<Count> level{.side = 1, .width = chart.width, .height = chart.height};
    const std::size_t cells = chart.lumel.size();
    level.count.resize(cells);
    level.centroid.assign(cells, glm::vec2(0.0f));
    level.normal = chart.normal;
    level.steps = chart.steps;
    level.is_split.assign(cells, 0);
    level.light.resize(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        const bool is = chart.lumel[i] != kNoLumel;
        level.count[i] = is ? 1.0f : 0.0f;
        level.light[i].fill(0.0f);
        for (std::size_t k = 0; is && k < Count; ++k)
            for (std::size_t c = 0; c < 3; ++c)
                level.light[i][3 * k + c] = (*found[k])[chart.lumel[i]][glm::length_t(c)];
    }
    return level;
}

template <std::size_t Count>
FitLevel<Count> coarser_level(const FitLevel<Count>& fine)
{
    FitLevel<Count> level{
        .side = 2 * fine.side, .width = (fine.width + 1) / 2, .height = (fine.height + 1) / 2};
    const std::size_t cells = std::size_t(level.width) * std::size_t(level.height);
    level.count.assign(cells, 0.0f);
    level.centroid.assign(cells, glm::vec2(0.0f));
    level.normal.assign(cells, glm::vec3(0.0f));
    level.steps.assign(cells, 0);
    level.is_split.assign(cells, 0);
    level.light.assign(cells, FitLight<Count>{});
    parallel_for(std::size_t(level.height), kCellsPerTask / std::size_t(level.width) + 1,
                 [&](std::size_t first, std::size_t last) {
                     for (int y = int(first); y < int(last); ++y)
                         for (int x = 0; x < level.width; ++x) {
                             average(fine, x, y, level);
                             find_borders(fine, x, y, level);
                         }
                 });
    return level;
}

template <std::size_t Count>
std::vector<FitLight<Count>> fitted_light(const FilterChart& chart, const FitLevel<Count>& level,
                                          const std::vector<FitLight<Count>>& finer)
{
    // A lumel of the finest level is at the centre of its cell, where all other terms are 0.
    const std::size_t rows = level.side == 1 ? 1 : kFitTerms;
    std::vector<FitLight<Count>> fits = fit_all(level, rows);
    if (level.side == 1)
        return fits;
    std::vector<FitLight<Count>> result(finer.size());
    const auto blend = [&](int x, int y) {
        const int own_x = x / level.side, own_y = y / level.side;
        const std::size_t own = level.at(own_x, own_y);
        if (!level.counts(own))
            return finer[chart.at(x, y)];
        const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float(level.side) - 0.5f;
        const glm::vec2 base = glm::floor(at), across = at - base;
        FitLight<Count> sum{};
        float weights = 0.0f;
        for (int n = 0; n < 4; ++n) {
            const int cx = int(base.x) + n % 2, cy = int(base.y) + n / 2;
            if (!level.is_open(own_x, own_y, cx - own_x, cy - own_y))
                continue;
            const float weight = (n % 2 == 1 ? across.x : 1.0f - across.x) *
                                 (n / 2 == 1 ? across.y : 1.0f - across.y);
            const Terms terms = terms_at(at - glm::vec2(cx, cy));
            for (std::size_t r = 0; r < kFitTerms; ++r)
                add_scaled<Count>(sum, weight * terms[r], fits[level.at(cx, cy) * rows + r]);
            weights += weight;
        }
        for (float& channel : sum)
            channel /= weights;
        return sum;
    };
    parallel_for(std::size_t(chart.height), kCellsPerTask / std::size_t(chart.width) + 1,
                 [&](std::size_t first, std::size_t last) {
                     for (int y = int(first); y < int(last); ++y)
                         for (int x = 0; x < chart.width; ++x)
                             result[chart.at(x, y)] = blend(x, y);
                 });
    return result;
}

template struct FitLevel<2>;
template struct FitLevel<3>;
template struct FitLevel<8>;
template FitLevel<2> finest_level(const FilterChart&, const std::array<const Estimates*, 2>&);
template FitLevel<3> finest_level(const FilterChart&, const std::array<const Estimates*, 3>&);
template FitLevel<8> finest_level(const FilterChart&, const std::array<const Estimates*, 8>&);
template FitLevel<2> coarser_level(const FitLevel<2>&);
template FitLevel<3> coarser_level(const FitLevel<3>&);
template FitLevel<8> coarser_level(const FitLevel<8>&);
template std::vector<FitLight<2>> fitted_light(const FilterChart&, const FitLevel<2>&,
                                               const std::vector<FitLight<2>>&);
template std::vector<FitLight<3>> fitted_light(const FilterChart&, const FitLevel<3>&,
                                               const std::vector<FitLight<3>>&);
template std::vector<FitLight<8>> fitted_light(const FilterChart&, const FitLevel<8>&,
                                               const std::vector<FitLight<8>>&);

}  // namespace lumel
