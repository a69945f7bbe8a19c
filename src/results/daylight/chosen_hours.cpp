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

/// The hours' light as rows [hours][n].
class Rows {
public:
    Rows(std::span<const float> root, std::span<const float> sources, std::uint32_t n)
        : n_(n),
          count_(std::uint32_t(sources.size() / n)),
          left_(sources.size()),
          lengths_(count_),
          parts_(count_)
    {
        blas::product({sources, count_, n_}, blas::transposed(root, n_, n_), left_);
        for (std::size_t h = 0; h < count_; ++h) {
            lengths_[h] = std::sqrt(dot(row(h), row(h)));
            lit_ += lengths_[h] > 0.0 ? 1.0 : 0.0;
            for (float& one : row(h))
                one *= lengths_[h] > 0.0 ? float(1.0 / lengths_[h]) : 0.0f;
        }
    }

    std::size_t count() const { return count_; }
    double length(std::size_t h) const { return lengths_[h]; }
    /// Parts of an hour along the basis.
    std::span<const double> parts(std::size_t h) const { return parts_[h]; }

    /// Squared length left of an hour.
    double left(std::size_t h) const { return dot(row(h), row(h)); }
    /// Mean of these.
    double left() const { return lit_ > 0.0 ? dot(left_, left_) / lit_ : 0.0; }

    /// The next hour; count() if only rounding is left.
    std::size_t best() const
    {
        std::vector<float> squares(std::size_t(n_) * n_), along(left_.size());
        blas::product(blas::transposed(left_, count_, n_), {left_, count_, n_}, squares);
        blas::product({left_, count_, n_}, {squares, n_, n_}, along);
        std::size_t found = count_;
        double most = 0.0;
        for (std::size_t h = 0; h < count_; ++h) {
            const double own = dot(row(h), row(h));
            const double taken =
                own > kRounding
                    ? dot(row(h), std::span(along).subspan(h * n_, n_)) / (own + kMapNoise)
                    : 0.0;
            if (taken > most) {
                most = taken;
                found = h;
            }
        }
        return found;
    }

    void take(std::size_t chosen)
    {
        std::vector<float> axis(row(chosen).begin(), row(chosen).end());
        const double length = std::sqrt(dot(axis, axis));
        for (float& one : axis)
            one = float(double(one) / length);
        for (std::size_t h = 0; h < count_; ++h) {
            const double part = dot(row(h), axis);
            parts_[h].push_back(part);
            for (std::size_t k = 0; k < n_; ++k)
                row(h)[k] -= float(part) * axis[k];
        }
    }

private:
    std::span<const float> row(std::size_t h) const { return std::span(left_).subspan(h * n_, n_); }
    std::span<float> row(std::size_t h) { return std::span(left_).subspan(h * n_, n_); }

    std::uint32_t n_, count_;
    std::vector<float> left_;
    std::vector<double> lengths_;
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
    const Rows light(root, sources, source_count), apart(root, difference, source_count);
    std::vector<double> found;
    for (std::size_t h = 0; h < light.count(); ++h)
        found.push_back(light.length(h) > 0.0 ? apart.length(h) / light.length(h) : 0.0);
    return found;
}

}  // namespace lumel
