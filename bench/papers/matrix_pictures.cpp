#include "bench/papers/matrix_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/matrix_codes.h"
#include "bench/papers/our_default.h"
#include "bench/reference.h"
#include "bench/stopwatch.h"
#include "links/direct/direct_rays.h"
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
constexpr std::uint32_t kNaiveBounces = 8;
constexpr float kEnlarged = 5.0f;  // differences are, to be seen

CodingOptions papers_settings(Code code, Reordering order)
{
    return {.code = code,
            .offset = float(kPapersOffset),
            .reordering = order,
            .mend = false,
            .spread = false};
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

std::vector<glm::vec3> direct_of(const SolveScene& world)
{
    DirectRays direct(world, 1, kMatrixError, {});
    do
        direct.step();
    while (!direct.state().full &&
           !(direct.state().error >= 0.0 && direct.state().error <= kMatrixError));
    return direct.irradiance();
}

/// The map of direct light and of what patches send through `matrix`, brought to lumels by their
/// rows of form factors [SF17 section 3.6].
Image map_through(const SolveScene& world, Transport& transport, ColorMatrix matrix,
                  const std::vector<glm::vec3>& direct)
{
    transport.bounces = std::move(matrix);
    std::vector<glm::vec3> light = transport.indirect(world.lumels, direct);
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] += direct[i];
    return finish_map(world.scene, world.atlas, world.lumels, light);
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
                 {"ln(entry / largest)", "code", "share %"}, kNoMatrix);
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
    const LogImage wanted = reordered(before, coded.decoding.order);
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
    auto method = options_of<MatrixOptions>(settings);
    method.transport.patches = patches;
    Transport transport = transport_of(device, world, method);
    const std::vector<glm::vec3> direct = direct_of(world);
    const ColorMatrix once =
        color_matrix(transport.form_factors, elements_of(transport.patches).color);
    const ColorMatrix blocks = decompress(compress_bc1(transport.bounces, {}));
    const Image by_naive = map_through(world, transport, bounces(once, kNaiveBounces - 1), direct);
    const Image by_blocks = map_through(world, transport, blocks, direct);
    const Solved by_matrix =
        solve_by(device, world, {.method = method, .target_error = kMatrixError});
    const Solved by_default = solve_by_default(device, world);
    const Image map_by_default = map_of(world, by_default);

    report.table("paths", "Beside path tracing ([SF17] figure 13)",
                 {"map", "cpu s", "from paths, RMSE %", "bias %"},
                 words_of(compare_maps(map_by_default, *truth).relative_rmse, by_default.cpu));
    report.row({"paths", fixed(watch.cpu, 1), none(), none()});
    const auto add = [&](const std::string& name, const Image& map, const Cell& cpu) {
        const MapError error = compare_maps(map, *truth);
        report.row({name, cpu, fixed(kPercent * error.relative_rmse, 2),
                    signed_fixed(kPercent * error.bias, 2)});
    };
    add(fmt::format("naive radiosity, {} bounces", kNaiveBounces), by_naive, none());
    add("--form bc1, last bounce by rows", by_blocks, none());
    add("--solver matrix, last bounce by rays", map_of(world, by_matrix), fixed(by_matrix.cpu, 1));

    const View view = choose_view(world.scene, world.rays);
    const auto draw = [&](const Image& map) {
        return render_preview(device, world.scene, world.atlas, map, view, width);
    };
    const Image by_paths = draw(*truth);
    const float exposure = choose_exposure(by_paths).value_or(1.0f);
    const auto picture = [&](const Image& map) { return tone_map(draw(map), exposure); };
    const std::string path = folder + "/matrix-and-paths.png";
    write_png(path, contact_sheet({{picture(by_naive), tone_map(by_paths, exposure)},
                                   {picture(by_blocks), picture(map_by_default)}}));
    report.picture(path, "[SF17] figures 13 and 14: above naive radiosity and path tracing, below "
                         "BC1 and our default. The papers' light propagation volume, a picture of "
                         "another engine, is left out: a column that it shows in one colour is a "
                         "gradient by paths");
}

}  // namespace lumel::bench
