// [SF17] figures 1 to 5, 7 to 10, 12 and 13: how form factors are distributed, and what compression
// costs; beyond the paper, error against bytes of every form.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include <fmt/format.h>

#include "base/core/usage.h"
#include "bench/papers/matrix_case.h"
#include "bench/papers/matrix_form.h"
#include "bench/papers/matrix_pictures.h"

namespace lumel::bench {
namespace {

constexpr double kPercent = 100.0;
constexpr double kMebibyte = 1048576.0;
constexpr float kLow = 5e-3f;  ///< below this most form factors lie [SF17]

/// Differences of entries. The numbers of figure 7 fit total = Σ e² and average = √total / entries.
struct EntryError {
    double sum = 0.0, squares = 0.0, largest = 0.0;
    double entries = 0.0;
};

EntryError entry_error(const ColorMatrix& found, const ColorMatrix& truth)
{
    EntryError error;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < truth.channel[c].values.size(); ++i) {
            const double off =
                std::abs(double(found.channel[c].values[i]) - double(truth.channel[c].values[i]));
            error.sum += off;
            error.squares += off * off;
            error.largest = std::max(error.largest, off);
            error.entries += 1.0;
        }
    return error;
}

/// Rows and columns in one random order.
ColorMatrix shuffled(const ColorMatrix& matrix)
{
    const std::uint32_t n = matrix.size();
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    ColorMatrix result = matrix;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                result.channel[c].values[i * n + j] = matrix.channel[c].at(order[i], order[j]);
    return result;
}

/// Bytes of F as floats, without colours.
double naive_bytes(const MatrixCase& matrix_case)
{
    return 4.0 * double(matrix_case.size()) * double(matrix_case.size());
}

/// As the paper writes: 0 in place of exact entries, each block for itself.
CodingOptions as_written(Code code = Code::bc1)
{
    return {.code = code, .mend = false, .spread = false};
}

void add_distribution(Report& report, const MatrixCase& matrix_case)
{
    constexpr std::array bounds = {0.0f,  1e-8f, 1e-7f, 1e-6f, 1e-5f,
                                   1e-4f, 1e-3f, 5e-3f, 1e-2f, 1e-1f};
    std::array<std::size_t, bounds.size() + 1> counts{};
    for (const float value : matrix_case.form_factors.values) {
        const auto above = std::lower_bound(bounds.begin(), bounds.end(), value);
        ++counts[std::size_t(above - bounds.begin())];
    }
    report.table("distribution", "Form factors ([SF17] figure 1)", {"form factor", "share %"},
                 kNoMatrix);
    const double all = double(matrix_case.form_factors.values.size());
    double below = 0.0;  // kLow
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const std::string range =
            k == 0 ? "0"
                   : (k < bounds.size() ? fmt::format("{:g} to {:g}", bounds[k - 1], bounds[k])
                                        : fmt::format("above {:g}", bounds[k - 1]));
        const double share = kPercent * double(counts[k]) / all;
        report.row({range, fixed(share, 3)});
        below += k < bounds.size() && bounds[k] <= kLow ? share : 0.0;
    }
    report.row({fmt::format("below {:g}", kLow), fixed(below, 3)});
}

void add_shares(Report& report, const MatrixCase& matrix_case, const std::vector<double>& shares)
{
    report.table("shares", "Error against the share kept exactly ([SF17] figure 2), BC1",
                 {"share %", "Σ e", "Σ e²", "largest", "light, RMSE %", "worst %", "naive / bytes"},
                 kNoMatrix);
    for (const double share : shares) {
        CodingOptions options;
        options.exact_share = float(share / kPercent);
        const CodedMatrix coded = encode(matrix_case.bounces, options);
        const ColorMatrix decoded = decode(coded);
        const EntryError error = entry_error(decoded, matrix_case.bounces);
        const StateError light = light_error(matrix_case, decoded);
        report.row({fmt::format("{:g}", share), fixed(error.sum, 1), fixed(error.squares, 4),
                    fixed(error.largest, 4), fixed(kPercent * light.mean, 2),
                    fixed(kPercent * light.worst, 2),
                    fixed(naive_bytes(matrix_case) / double(coded.bytes()), 2)});
    }
}

struct BlockEncoder {
    const char* name;
    CodingOptions options;
};

/// Of one format, which any decoder of BC1 reads.
std::vector<BlockEncoder> encoders()
{
    CodingOptions restored = as_written();
    restored.mend = true;
    return {{"as written, blocks of codes", as_written(Code::bc1_of_codes)},
            {"as written, blocks of entries", as_written()},
            {"exact part restored", restored},
            {"--form bc1", CodingOptions{}}};
}

void add_reorderings(Report& report, const ColorMatrix& matrix, const char* patches)
{
    constexpr std::array names = {"as it is", "rows", "rows and columns"};
    for (const BlockEncoder& encoder : encoders()) {
        EntryError without;
        for (const Reordering how :
             {Reordering::none, Reordering::rows, Reordering::rows_and_columns}) {
            CodingOptions options = encoder.options;
            options.reordering = how;
            const EntryError error = entry_error(decode(encode(matrix, options)), matrix);
            if (how == Reordering::none)
                without = error;
            report.row({patches, encoder.name, names[std::size_t(how)],
                        significant(std::sqrt(error.squares) / error.entries, 3),
                        fixed(error.largest, 4), fixed(error.squares, 4),
                        fixed(without.squares / error.squares, 2), fixed(error.sum, 1),
                        fixed(without.sum / error.sum, 2)});
        }
    }
}

void add_reorderings(Report& report, const MatrixCase& matrix_case)
{
    report.table("reordering", "Error by reordering ([SF17] figure 7), BC1",
                 {"patches come", "encoder", "order", "average: √Σe² / entries", "largest",
                  "total: Σ e²", "Σ e²: without / this", "Σ e", "Σ e: without / this"},
                 kNoMatrix);
    add_reorderings(report, matrix_case.bounces, "by place");
    add_reorderings(report, shuffled(matrix_case.bounces), "shuffled");
}

struct FormOfCurve {
    std::string name;
    std::function<AnyMatrix()> make;
};

std::vector<FormOfCurve> forms_of(const MatrixCase& matrix_case)
{
    const auto coded = [&](const CodingOptions& options) {
        return [&, options] { return AnyMatrix(encode(matrix_case.bounces, options)); };
    };
    std::vector<FormOfCurve> forms;
    const auto add = [&](std::string name, std::function<AnyMatrix()> make) {
        forms.push_back({std::move(name), std::move(make)});
    };
    add("float", coded({.code = Code::float32}));
    add("half", coded({.code = Code::float16}));
    for (const auto& [code, name] :
         {std::pair{Code::log8, "8-bit logarithm"}, std::pair{Code::bc4, "BC4"}}) {
        const Reordering order =
            code == Code::log8 ? Reordering::none : Reordering::rows_and_columns;
        add(fmt::format("{}, as written", name),
            coded({.code = code, .reordering = order, .mend = false}));
        add(fmt::format("{}, restored, offset 12", name),
            coded({.code = code, .offset = 12.0f, .reordering = order}));
    }
    for (const BlockEncoder& encoder : encoders())
        add(fmt::format("BC1, {}", encoder.name), coded(encoder.options));
    add("BC1, --form bc1 without reordering", coded({.reordering = Reordering::none}));
    add("BC1, --form bc1 with offset 12", coded({.offset = 12.0f}));
    add("BC1, --form bc1 with 1 % exact", coded({.exact_share = 0.01f}));
    for (const std::uint32_t part : {64u, 32u, 16u, 8u, 4u}) {
        const std::uint32_t rank = matrix_case.size() / part;
        add(fmt::format("low rank, {}", rank), [&, rank] {
            return AnyMatrix(compress_low_rank(matrix_case.bounces, matrix_case.elements, rank));
        });
    }
    for (const float error : {0.05f, 0.02f, 0.01f})
        add(fmt::format("blocks of low rank, error {:g} %", kPercent * double(error)), [&, error] {
            return AnyMatrix(compress_hierarchy(matrix_case.bounces, matrix_case.elements, error));
        });
    for (const float error : {0.1f, 0.05f, 0.02f, 0.01f, 0.005f, 0.002f})
        add(fmt::format("tiles, error {:g} %", kPercent * double(error)), [&, error] {
            return AnyMatrix(
                compress_tiles(matrix_case.bounces, matrix_case.elements, {.error = error}));
        });
    return forms;
}

/// Of forms whose names have `wanted` in them.
void add_curve(Report& report, const MatrixCase& matrix_case, const std::string& wanted)
{
    report.table("curve",
                 fmt::format("Bytes ([SF17] figure 12) and error of indirect light, {} states; "
                             "naive: F as floats, without colours, {:.2f} MiB",
                             matrix_case.lights.size(), naive_bytes(matrix_case) / kMebibyte),
                 {"form", "MiB", "naive / bytes", "RMSE %", "worst state %", "seconds"}, kNoMatrix);
    for (const FormOfCurve& form : forms_of(matrix_case)) {
        if (form.name.find(wanted) == std::string::npos)
            continue;
        const double begin = wall_seconds();
        const AnyMatrix compressed = form.make();
        const double seconds = wall_seconds() - begin;
        const StateError error = light_error(matrix_case, whole(compressed));
        report.row({form.name, fixed(double(bytes_of(compressed)) / kMebibyte, 2),
                    fixed(naive_bytes(matrix_case) / double(bytes_of(compressed)), 2),
                    fixed(kPercent * error.mean, 3), fixed(kPercent * error.worst, 3),
                    fixed(seconds, 1)});
    }
}

}  // namespace

void compare_matrix_forms(const MatrixSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    for (const int patches : settings.patches) {
        const double begin = wall_seconds();
        const MatrixCase matrix_case =
            make_matrix_case(device, settings.shared, std::uint32_t(patches), settings.lights);
        report.say(fmt::format("{}, {} patches, {:.0f} s to make, {}", settings.shared.scene,
                               matrix_case.size(), wall_seconds() - begin, words_of(device)));
        add_curve(report, matrix_case, settings.forms);
        if (!settings.forms.empty())
            continue;
        add_distribution(report, matrix_case);
        add_logarithms(report, matrix_case);
        add_reorderings(report, matrix_case);
        add_shares(report, matrix_case, settings.shares);
        if (settings.folder.empty())
            continue;
        draw_matrix(report, matrix_case, settings.folder);
        draw_beside_paths(device, settings.shared, std::uint32_t(patches), settings.width,
                          settings.folder, report);
    }
}

}  // namespace lumel::bench
