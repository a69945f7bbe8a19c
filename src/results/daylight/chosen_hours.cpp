// With coefficients C of sources at places, the light of an hour of strengths s is C s. Its
// products with the light of other hours are those of y = Λ^½ Q s, where Cᵀ C = Qᵀ Λ Q: as many
// numbers as there are sources, not places. Rows y are divided by their length, so that each hour
// counts alike; the chosen ones are a basis, made orthonormal one by one (Gram-Schmidt). Taken next
// is the hour whose direction d in what is left, R, takes most away: the largest |R d|².

#include "results/daylight/chosen_hours.h"

#include <algorithm>
#include <cmath>

#include "results/daylight/dot.h"
#include "solve/matrix/blas.h"

namespace lumel {
namespace {

/// Squared length left of a row of length 1, below which rounding is all that it has.
constexpr double kRounding = 1e-6;
/// Squared noise of a map, relative to its light. A row of which less is left is nearly a sum of
/// others: its weights would multiply noise.
constexpr double kMapNoise = 0.03 * 0.03;

using Row = std::vector<double>;

/// The hours' light [hours][n].
std::vector<Row> light_rows(std::span<const float> root, std::span<const float> sources,
                            std::uint32_t n)
{
    std::vector<Row> rows(sources.size() / n, Row(n));
    std::vector<float> light(sources.size());
    blas::product({sources, std::uint32_t(rows.size()), n}, blas::transposed(root, n, n), light);
    for (std::size_t h = 0; h < rows.size(); ++h)
        std::copy_n(&light[h * n], n, rows[h].begin());
    return rows;
}

/// Residuals of the hours' light as rows R [hours][n], and their products Rᵀ R [n][n]. In double
/// precision: small residuals are differences of large numbers.
class Rows {
public:
    Rows(std::span<const float> root, std::span<const float> sources, std::uint32_t n)
        : left_(light_rows(root, sources, n)),
          products_(n, Row(n)),
          parts_(left_.size())
    {
        for (std::size_t h = 0; h < left_.size(); ++h) {
            lengths_.push_back(std::sqrt(left(h)));
            lit_ += lengths_[h] > 0.0 ? 1.0 : 0.0;
            for (double& one : left_[h])
                one *= lengths_[h] > 0.0 ? 1.0 / lengths_[h] : 0.0;
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t j = 0; j < n; ++j)
                    products_[k][j] += left_[h][k] * left_[h][j];
        }
        for (const Row& row : left_)
            taken_.push_back(dot(row, multiplied(row)));
    }

    std::size_t count() const { return left_.size(); }
    double length(std::size_t h) const { return lengths_[h]; }
    /// Parts of an hour along the basis.
    std::span<const double> parts(std::size_t h) const { return parts_[h]; }

    /// Squared length left of an hour.
    double left(std::size_t h) const { return dot(left_[h], left_[h]); }
    /// Mean of these.
    double left() const
    {
        double sum = 0.0;
        for (const Row& row : left_)
            sum += dot(row, row);
        return lit_ > 0.0 ? sum / lit_ : 0.0;
    }

    /// The next hour; count() if only rounding is left.
    std::size_t best() const
    {
        std::size_t found = count();
        double most = 0.0;
        for (std::size_t h = 0; h < count(); ++h) {
            const double own = left(h);
            const double taken = own > kRounding ? taken_[h] / (own + kMapNoise) : 0.0;
            if (taken > most) {
                most = taken;
                found = h;
            }
        }
        return found;
    }

    /// Takes the part along an hour's row, of direction a, from all rows r: r - (r·a) a. taken_
    /// and products_ follow, since aᵀ Rᵀ R is known.
    void take(std::size_t chosen)
    {
        Row axis = left_[chosen];
        const double length = std::sqrt(dot(axis, axis));
        for (double& one : axis)
            one /= length;
        const Row along = multiplied(axis);
        const double whole = dot(axis, along);
        for (std::size_t h = 0; h < count(); ++h) {
            const double part = dot(left_[h], axis);
            parts_[h].push_back(part);
            taken_[h] += part * (part * whole - 2.0 * dot(left_[h], along));
            for (std::size_t k = 0; k < axis.size(); ++k)
                left_[h][k] -= part * axis[k];
        }
        for (std::size_t k = 0; k < axis.size(); ++k)
            for (std::size_t j = 0; j < axis.size(); ++j)
                products_[k][j] +=
                    axis[k] * axis[j] * whole - axis[k] * along[j] - along[k] * axis[j];
    }

private:
    Row multiplied(const Row& row) const
    {
        Row found;
        for (const Row& products : products_)
            found.push_back(dot(products, row));
        return found;
    }

    std::vector<Row> left_, products_;
    std::vector<double> taken_;    ///< |R r|² of each row r
    std::vector<double> lengths_;  ///< at first
    double lit_ = 0.0;
    std::vector<std::vector<double>> parts_;
};

/// Weights of the chosen hours for one: their parts are a triangle.
std::vector<double> weights_of(const Rows& rows, std::span<const std::size_t> chosen,
                               std::size_t hour)
{
    std::vector<double> weights(rows.parts(hour).begin(), rows.parts(hour).end());
    for (std::size_t k = chosen.size(); k-- > 0;) {
        const std::span<const double> own = rows.parts(chosen[k]);
        weights[k] /= own[k];
        for (std::size_t j = 0; j < k; ++j)
            weights[j] -= weights[k] * own[j];
    }
    return weights;
}

}  // namespace

std::vector<float> light_root(std::span<const float> coefficients, std::uint32_t n)
{
    const auto rows = std::uint32_t(coefficients.size() / n);
    std::vector<float> squares(std::size_t(n) * n), projected(squares.size());
    blas::product(blas::transposed(coefficients, rows, n), {coefficients, rows, n}, squares);
    std::vector<float> root = squares;
    blas::eigenvectors(root, n);
    blas::product({root, n, n}, {squares, n, n}, projected);
    for (std::size_t k = 0; k < n; ++k) {
        const std::span<float> row = std::span(root).subspan(k * n, n);
        const double value = dot(row, std::span(projected).subspan(k * n, n));
        for (float& one : row)
            one *= float(std::sqrt(std::max(value, 0.0)));
    }
    return root;
}

ChosenHours choose_hours(std::span<const float> root, std::span<const float> sources,
                         std::uint32_t source_count, double error, std::size_t most)
{
    Rows rows(root, sources, source_count);
    ChosenHours found;
    while (found.hours.size() < most && rows.left() > error * error) {
        const std::size_t next = rows.best();
        if (next == rows.count())
            break;
        rows.take(next);
        found.hours.push_back(next);
    }
    found.error = std::sqrt(rows.left());
    for (std::size_t h = 0; h < rows.count(); ++h) {
        found.errors.push_back(std::sqrt(rows.left(h)));
        const std::vector<double> weights = weights_of(rows, found.hours, h);
        for (std::size_t k = 0; k < weights.size(); ++k)
            found.weights.push_back(
                float(weights[k] * rows.length(h) / rows.length(found.hours[k])));
    }
    return found;
}

std::vector<double> relative_difference(std::span<const float> root, std::span<const float> sources,
                                        std::span<const float> others, std::uint32_t source_count)
{
    std::vector<float> difference(sources.begin(), sources.end());
    for (std::size_t k = 0; k < difference.size(); ++k)
        difference[k] -= others[k];
    const std::vector<Row> light = light_rows(root, sources, source_count),
                           apart = light_rows(root, difference, source_count);
    std::vector<double> found;
    for (std::size_t h = 0; h < light.size(); ++h) {
        const double square = dot(light[h], light[h]);
        found.push_back(square > 0.0 ? std::sqrt(dot(apart[h], apart[h]) / square) : 0.0);
    }
    return found;
}

}  // namespace lumel
