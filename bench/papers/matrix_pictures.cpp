#include "bench/papers/matrix_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/matrix_codes.h"
#include "bench/reference.h"
#include "bench/stopwatch.h"
#include "methods/matrix/matrix.h"
#include "results/preview/preview.h"
#include "solve/solver/solver.h"
#include "truth/metrics.h"

namespace lumel::bench {
namespace {

constexpr double kPercent = 100.0;
constexpr float kWhite = 255.0f;         // the largest code
constexpr double kPapersOffset = 25.0;   // that the paper adds to logarithms
constexpr double kBinWidth = 2.5;        // of natural logarithms, a tenth of the offset
constexpr int kBins = 12;                // down to −30, where the paper's figure 3 begins
constexpr std::uint32_t kMaxSide = 256;  // of a picture of a matrix [pixels]
constexpr double kMatrixError = 0.01;    // stated, of direct light, which the matrix is given
constexpr float kEnlarged = 5.0f;        // differences are, to be seen

CodingOptions papers_settings(Code code, Reordering order)
{
    return {.code = code, .offset = float(kPapersOffset), .reordering = order, .mend = false};
}

/// Means of squares of texels, so that a picture is at most kMaxSide wide.
Image picture_of(const LogImage& image, std::uint32_t rows)
{
    const std::uint32_t square = (rows + kMaxSide - 1) / kMaxSide;
    const int side = int(rows / square);
    Image picture(side, side, 4);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float* pixel = picture.at(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0.0f;
                for (std::uint32_t i = 0; i < square * square; ++i)
                    sum += image.channel[c][(std::size_t(y) * square + i / square) * image.side +
                                            std::size_t(x) * square + i % square];
                pixel[c] = std::min(sum / (kWhite * float(square * square)), 1.0f);
            }
            pixel[3] = 1.0f;
        }
    return picture;
}

/// |a − b| × kEnlarged of the first `channels` channels; the others stay 0.
LogImage difference(const LogImage& a, const LogImage& b, std::size_t channels)
{
    LogImage result = a;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < a.channel[c].size(); ++i)
            result.channel[c][i] =
                c < channels ? kEnlarged * std::abs(a.channel[c][i] - b.channel[c][i]) : 0.0f;
    return result;
}

struct Solved {
    Image map;
    double cpu = 0.0;  ///< [s]
};

Solved solve_by_matrix(const gpu::Device& device, const Settings& settings, const SolveScene& world,
                       std::uint32_t patches)
{
    auto method = options_of<MatrixOptions>(settings);
    method.transport.patches = patches;
    const SolverOptions options{.method = method, .target_error = kMatrixError};
    Stopwatch watch;
    watch.start();
    const NearField near = near_field_for(world.scene, world.rays, world.lumels, options);
    const World resident(device, world.scene, world.lumels);
    const auto solver = make_solver({.device = &device,
                                     .world = &resident,
                                     .lumels = world.lumels,
                                     .near = near,
                                     .scene = &world},
                                    options);
    solve(*solver, options);
    Image map = finish_map(world.scene, world.atlas, world.lumels, solver->irradiance());
    watch.stop();
    return {std::move(map), watch.cpu};
}

}  // namespace

void add_logarithms(Report& report, const MatrixCase& matrix_case)
{
    const SparsePart exact = largest_entries(matrix_case.bounces, CodingOptions{}.exact_share);
    std::array<std::size_t, kBins> counts{};
    std::size_t zero = 0, below = 0, all = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> values = matrix_case.bounces.channel[c].values;
        for (std::size_t entry = 0; entry < exact.value[c].size(); ++entry)
            values[entry / exact.per_row * exact.size + exact.column[c][entry]] = 0.0f;
        const double largest = double(*std::max_element(values.begin(), values.end()));
        for (const float value : values) {
            ++all;
            if (!(value > 0.0f)) {
                ++zero;
                continue;
            }
            const auto bin = std::size_t(-std::log(double(value) / largest) / kBinWidth);
            ++(bin < counts.size() ? counts[bin] : below);
        }
    }
    report.table("logarithms",
                 "Entries but the largest 4 % of a row, as logarithms ([SF17] figure 3) and as "
                 "codes after 25 is added (figure 4)",
                 {"ln(entry / largest)", "code", "share %"});
    const auto share = [&](std::size_t count) {
        return fixed(kPercent * double(count) / double(all), 2);
    };
    const auto code = [](double logarithm) {
        return std::max(0.0, double(kWhite) * (logarithm / kPapersOffset + 1.0));
    };
    for (int bin = 0; bin < kBins; ++bin) {
        const double high = -kBinWidth * bin, low = high - kBinWidth;
        report.row({fmt::format("{:g} to {:g}", low, high),
                    fmt::format("{:.0f} to {:.0f}", code(low), code(high)),
                    share(counts[std::size_t(bin)])});
    }
    report.row({fmt::format("below {:g}", -kBinWidth * kBins), "0", share(below)});
    report.row({"of 0, and kept exactly", "0", share(zero)});
}

void draw_matrix(Report& report, const MatrixCase& matrix_case, const std::string& folder)
{
    std::filesystem::create_directories(folder);
    const LogImage before =
        image_of(encode(matrix_case.bounces, papers_settings(Code::log8, Reordering::none)));
    const CodedMatrix coded =
        encode(matrix_case.bounces, papers_settings(Code::bc1, Reordering::rows_and_columns));
    const LogImage after = image_of(coded);
    const LogImage wanted =
        reordered(before, coded.decoding.row_order, coded.decoding.column_order);
    const std::uint32_t n = matrix_case.size();
    const std::string path = folder + "/matrix.png";
    write_png(path, contact_sheet({{picture_of(before, n), picture_of(after, n),
                                    picture_of(difference(after, wanted, 1), n),
                                    picture_of(difference(after, wanted, 3), n)}}));
    report.picture(path,
                   "[SF17] figures 5, 8, 9 and 10: codes of the matrix before reordering, out of "
                   "BC1 after both reorderings, and how far these are off in red and in all "
                   "channels, times 5");
}

void draw_beside_paths(const gpu::Device& device, const Settings& settings, std::uint32_t patches,
                       int width, const std::string& folder, Report& report)
{
    const SolveScene world = prepare(settings, settings.size);
    Stopwatch watch;
    watch.start();
    const std::optional<Image> truth = reference_map(settings, world);
    watch.stop();
    if (!truth)
        return;
    const Solved found = solve_by_matrix(device, settings, world, patches);
    const MapError error = compare_maps(found.map, *truth);
    report.table("paths", "Beside path tracing ([SF17] figure 13)",
                 {"map", "cpu s", "from paths, RMSE %", "bias %"});
    report.row({"paths", fixed(watch.cpu, 1), none(), none()});
    report.row({"matrix, made and solved once", fixed(found.cpu, 1),
                fixed(kPercent * error.relative_rmse, 2), signed_fixed(kPercent * error.bias, 2)});
    const View view = choose_view(world.scene, world.rays);
    const Image by_matrix =
        render_preview(device, world.scene, world.atlas, found.map, view, width);
    const Image by_paths = render_preview(device, world.scene, world.atlas, *truth, view, width);
    const float exposure = choose_exposure(by_paths).value_or(1.0f);
    const std::string path = folder + "/matrix-and-paths.png";
    write_png(path, contact_sheet({{tone_map(by_matrix, exposure), tone_map(by_paths, exposure)}}));
    report.picture(path, "Left by the matrix, right by path tracing");
}

}  // namespace lumel::bench
