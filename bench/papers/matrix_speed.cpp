// [SF17] figure 11: one multiply by the matrix of all reflections against naive radiosity, which
// multiplies by F once for each of them. Both read their matrices by the same kernels.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <type_traits>

#include <fmt/format.h>

#include "base/core/error.h"
#include "bench/papers/matrix_case.h"
#include "bench/papers/matrix_codes_product.h"
#include "bench/papers/matrix_form.h"
#include "bench/papers/matrix_frame.h"
#include "bench/papers/matrix_hierarchy_product.h"
#include "bench/papers/matrix_low_rank_product.h"
#include "bench/papers/matrix_speed.reflect.comp.h"
#include "bench/papers/matrix_speed.row.comp.h"
#include "bench/papers/matrix_speed.shared.h"
#include "bench/papers/our_default.h"
#include "bench/stopwatch.h"
#include "solve/matrix/multiply.h"

namespace lumel::bench {
namespace {

constexpr int kStretches = 3;  // the fastest counts
constexpr double kGigabyte = 1e9;
constexpr int kGrowthLights = 4;  // states that errors are taken of
// Asked of codes, so that about 1 % of the light is lost by either.
constexpr float kTilesError = 0.01f, kBlocksError = 0.02f;

struct Time {
    double cpu_ms = std::numeric_limits<double>::max();
    double wall_ms = std::numeric_limits<double>::max();
};

Time time_of(const gpu::Device& device, int repeats,
             const std::function<void(gpu::Commands&)>& record)
{
    Time time;
    gpu::Commands commands(device);
    record(commands);  // the driver compiles what it meets for the first time
    commands.run();
    for (int stretch = 0; stretch < kStretches; ++stretch) {
        Stopwatch watch;
        watch.start();
        for (int i = 0; i < repeats; ++i)
            record(commands);
        commands.run();
        watch.stop();
        time.cpu_ms = std::min(time.cpu_ms, 1e3 * watch.cpu / repeats);
        time.wall_ms = std::min(time.wall_ms, 1e3 * watch.wall / repeats);
    }
    return time;
}

/// incident_total of k reflections, one after the other [SF17 Eqs. (3), (4)].
class NaiveRadiosity {
public:
    NaiveRadiosity(const gpu::Device& device, const MatrixCase& matrix_case)
        : count_(matrix_case.size()),
          width_(filled_up(count_)),
          color_(device, std::span<const glm::vec3>(matrix_case.elements.color)),
          sent_(device, std::size_t(width_) * 3),
          received_(device, std::size_t(width_) * 3),
          gather_(device, count_, width_, {}, matrix_case.elements.color),
          product_(device, Code::float32, std::span(&words_of(matrix_case), 1), count_, count_, {}),
          reflect_(device)
    {
        words_.clear();
    }

    void record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                const gpu::Array<glm::vec3>& y, int bounces)
    {
        commands.fill(y.buffer());
        gather_.record(commands, x, sent_, 1);
        for (int bounce = 0; bounce < bounces; ++bounce) {
            product_.record(commands, sent_, received_, width_, 1);
            commands.dispatch(
                reflect_, {.color = color_, .incident = received_, .excident = sent_, .total = y},
                ReflectParams{count_, width_}, count_);
        }
    }

private:
    const std::vector<std::uint32_t>& words_of(const MatrixCase& matrix_case)
    {
        const SquareMatrix& factors = matrix_case.form_factors;
        const ColorMatrix gray{{factors, factors, factors}};
        words_ = encode(gray, {.code = Code::float32}).words[0];
        return words_;
    }

    std::uint32_t count_, width_;
    std::vector<std::uint32_t> words_;
    gpu::Array<glm::vec3> color_;
    gpu::Array<float> sent_, received_;
    Gather gather_;
    RowsProduct product_;
    gpu::Kernel<shaders::MatrixSpeedReflect> reflect_;
};

using Record =
    std::function<void(gpu::Commands&, const gpu::Array<glm::vec3>&, const gpu::Array<glm::vec3>&)>;

double difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b)
{
    double off = 0.0, all = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(a[i]) - glm::dvec3(b[i]);
        off += glm::dot(d, d);
        all += glm::dot(glm::dvec3(b[i]), glm::dvec3(b[i]));
    }
    return std::sqrt(off / all);
}

/// A matrix and its product, which is made when it is timed.
struct TimedForm {
    std::string name;
    std::size_t bytes;
    std::function<Record(const gpu::Device&)> product;
};

/// Product: constructed of the device and the matrix.
template <class Product, class Matrix>
TimedForm form_of(std::string name, Matrix matrix)
{
    const std::size_t bytes = matrix.bytes();
    return {std::move(name), bytes, [matrix = std::move(matrix)](const gpu::Device& device) {
                const auto product = std::make_shared<Product>(device, matrix, 1u);
                return [product](gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                                 const gpu::Array<glm::vec3>& y) {
                    product->record(commands, x, y, 1u);
                };
            }};
}

std::vector<TimedForm> forms_of(const MatrixCase& matrix_case, bool textures)
{
    std::vector<TimedForm> forms;
    for (const auto& [code, name] :
         {std::pair{Code::float32, "float"}, std::pair{Code::float16, "half"},
          std::pair{Code::log8, "8-bit logarithm"}, std::pair{Code::bc4, "BC4"},
          std::pair{Code::bc1, "BC1"}})
        forms.push_back(form_of<MultiplyCoded>(name, encode(matrix_case.bounces, {.code = code})));
    if (textures)
        forms.push_back(
            form_of<MultiplyBc1>("BC1, texture", compress_bc1(matrix_case.bounces, {})));
    const std::uint32_t rank = matrix_case.size() / 8;
    forms.push_back(form_of<MultiplyLowRank>(
        fmt::format("low rank, {}", rank),
        compress_low_rank(matrix_case.bounces, matrix_case.elements, rank)));
    for (const float error : {0.01f, 0.005f})
        forms.push_back(form_of<MultiplyTiles>(
            fmt::format("tiles, error {:g} %", 100.0 * double(error)),
            compress_tiles(matrix_case.bounces, matrix_case.elements, {.error = error})));
    return forms;
}

void add_against_naive(Report& report, const gpu::Device& device, const MatrixCase& matrix_case,
                       const MatrixSpeedSettings& settings)
{
    report.table(
        "speed",
        fmt::format("One multiply against naive radiosity of {} bounces ([SF17] figure "
                    "11): {}, {} patches",
                    settings.bounces.back(), settings.shared.scene, matrix_case.size()),
        {"what", "MiB", "cpu ms", "wall ms", "naive / this, cpu", "naive / this, wall",
         "naive / this", "difference from all bounces %"},
        fmt::format("whole map, {:.2f} s",
                    solve_by_default(device, prepare(settings.shared, settings.shared.size)).cpu));
    const std::vector<glm::vec3>& light = matrix_case.lights.front();
    const std::vector<glm::vec3> truth = multiply(matrix_case.bounces, light);
    const gpu::Array<glm::vec3> x(device, std::span<const glm::vec3>(light));
    const gpu::Array<glm::vec3> y(device, light.size());
    const double n = double(matrix_case.size()), mebi = 1048576.0;

    const bool by_processor = counts_processor_time(device);
    NaiveRadiosity naive(device, matrix_case);
    Time naive_time;
    for (const int bounces : settings.bounces) {
        naive_time = time_of(device, settings.repeats, [&](gpu::Commands& commands) {
            naive.record(commands, x, y, bounces);
        });
        report.row({fmt::format("naive, {} bounces", bounces), fixed(4.0 * n * n / mebi, 2),
                    fixed(naive_time.cpu_ms, 2), fixed(naive_time.wall_ms, 2), none(), none(),
                    none(), fixed(100.0 * difference(y.download(), truth), 3)});
    }
    for (const TimedForm& form : forms_of(matrix_case, device.can_read_blocks())) {
        const Record product = form.product(device);
        const Time time = time_of(device, settings.repeats,
                                  [&](gpu::Commands& commands) { product(commands, x, y); });
        report.row({form.name, fixed(double(form.bytes) / mebi, 2), fixed(time.cpu_ms, 2),
                    fixed(time.wall_ms, 2), fixed(naive_time.cpu_ms / time.cpu_ms, 1),
                    fixed(naive_time.wall_ms / time.wall_ms, 1),
                    fixed(by_processor ? naive_time.cpu_ms / time.cpu_ms
                                       : naive_time.wall_ms / time.wall_ms,
                          1),
                    fixed(100.0 * difference(y.download(), truth), 3)});
    }
}

void add_growth(Report& report, const gpu::Device& device, const MatrixSpeedSettings& settings)
{
    report.table("growth",
                 fmt::format("Bytes and multiplies as patches grow, {}: beyond the paper",
                             settings.shared.scene),
                 {"patches", "form", "MiB", "bytes / patch", "naive / bytes", "cpu ms", "wall ms",
                  "light, RMSE %", "seconds to compress"},
                 kNoMatrix);
    const double mebi = 1048576.0;
    for (const int patches : settings.growth) {
        const MatrixCase matrix_case =
            make_matrix_case(device, settings.shared, std::uint32_t(patches), kGrowthLights);
        const std::vector<glm::vec3>& light = matrix_case.lights.front();
        const gpu::Array<glm::vec3> x(device, std::span<const glm::vec3>(light));
        const gpu::Array<glm::vec3> y(device, light.size());
        const double n = double(matrix_case.size()), naive = 4.0 * n * n;
        const auto add = [&]<class Product>(const char* name, const auto& matrix,
                                            std::type_identity<Product>, double seconds) {
            Product product(device, matrix, 1u);
            const Time time = time_of(device, settings.repeats, [&](gpu::Commands& commands) {
                product.record(commands, x, y, 1u);
            });
            const double bytes = double(matrix.bytes());
            report.row({fmt::format("{}", matrix_case.size()), name, fixed(bytes / mebi, 2),
                        fixed(bytes / n, 0), fixed(naive / bytes, 1), fixed(time.cpu_ms, 2),
                        fixed(time.wall_ms, 2),
                        fixed(100.0 * light_error(matrix_case, whole(AnyMatrix(matrix))).mean, 2),
                        fixed(seconds, 1)});
        };
        const auto timed = [](const auto& make) {
            const double begin = cpu_seconds();
            auto made = make();
            return std::pair{std::move(made), cpu_seconds() - begin};
        };
        const auto [bc1, of_bc1] = timed([&] { return encode(matrix_case.bounces, {}); });
        add("BC1", bc1, std::type_identity<MultiplyCoded>(), of_bc1);
        const auto [blocks, of_blocks] = timed([&] {
            return compress_hierarchy(matrix_case.bounces, matrix_case.elements, kBlocksError);
        });
        add("blocks of low rank", blocks, std::type_identity<MultiplyHierarchy>(), of_blocks);
        const auto [tiles, of_tiles] = timed([&] {
            return compress_tiles(matrix_case.bounces, matrix_case.elements,
                                  {.error = kTilesError});
        });
        add("tiles", tiles, std::type_identity<MultiplyTiles>(), of_tiles);
    }
}

/// Random words: as valid as any, but for floats, which are drawn.
CodedMatrix random_matrix(Code code, std::uint32_t n)
{
    CodedMatrix matrix{.code = code,
                       .decoding = {.size = n, .largest = {1.0f, 1.0f, 1.0f}, .offset = 25.0f},
                       .words = {}};
    std::mt19937 random(1);
    for (std::size_t c = 0; c < (is_bc1(code) ? 1u : 3u); ++c) {
        const std::size_t side = filled_up(n);
        matrix.words[c].resize(side * side * bits_of(code) / 32);
        for (std::uint32_t& word : matrix.words[c]) {
            word = std::uint32_t(random());
            if (code == Code::float32)
                word = 0x3f000000u | (word & 0x7fffffu);  // 0.5…1
            if (code == Code::float16)
                word = 0x38003800u | (word & 0x03ff03ffu);
        }
    }
    return matrix;
}

/// The float matrix read by one group for each row.
class RowByRow {
public:
    RowByRow(const gpu::Device& device, const CodedMatrix& matrix)
        : quads_(filled_up(matrix.decoding.size) / 4),
          rows_(matrix.decoding.size),
          kernel_(device)
    {
        const std::size_t row_words = std::size_t(quads_) * 4;
        const std::uint32_t most = std::min(
            rows_, std::uint32_t(device.max_array_bytes() / (row_words * sizeof(std::uint32_t))));
        for (std::uint32_t c = 0; c < 3; ++c)
            for (std::uint32_t row = 0; row < rows_; row += most) {
                const std::uint32_t count = std::min(most, rows_ - row);
                parts_.push_back(
                    {c * rows_ + row, count,
                     gpu::Array<std::uint32_t>(
                         device,
                         std::span(matrix.words[c]).subspan(row * row_words, count * row_words))});
            }
    }

    void record(gpu::Commands& commands, const gpu::Array<float>& in, const gpu::Array<float>& out)
    {
        for (const Part& part : parts_)
            commands.dispatch(
                kernel_,
                {.matrix = gpu::packed(part.words), .vectors = gpu::packed(in), .result = out},
                RowParams{quads_, part.first_row, rows_}, std::size_t(part.rows) * kRowLanes);
    }

private:
    struct Part {
        std::uint32_t first_row, rows;
        gpu::Array<std::uint32_t> words;
    };

    std::uint32_t quads_, rows_;
    std::vector<Part> parts_;
    gpu::Kernel<shaders::MatrixSpeedRow> kernel_;
};

/// Bytes per second that a copy on the device reads and writes.
double copy_bandwidth(const gpu::Device& device, int repeats)
{
    constexpr std::uint64_t bytes = std::uint64_t(128) << 20;  // any device allows
    const gpu::Buffer from(device, bytes), to(device, bytes);
    const Time time =
        time_of(device, repeats, [&](gpu::Commands& commands) { commands.copy(from, to, bytes); });
    return 2.0 * double(bytes) / (1e-3 * time.wall_ms);
}

void add_large(Report& report, const gpu::Device& device, const MatrixSpeedSettings& settings)
{
    const auto n = std::uint32_t(settings.large);
    const double copy = copy_bandwidth(device, settings.repeats);
    report.table("multiply",
                 fmt::format("The multiply alone, {} × {} random numbers for each channel. A copy "
                             "reads and writes {:.2f} GB/s",
                             n, n, copy / kGigabyte),
                 {"kernel", "MiB", "cpu ms", "wall ms", "row by row / this, cpu",
                  "row by row / this, wall", "GB/s read", "of the copy %"},
                 kNoMatrix);
    const std::vector<float> ones(std::size_t(filled_up(n)) * 3, 1.0f);
    const gpu::Array<float> in(device, std::span<const float>(ones));
    const gpu::Array<float> out(device, ones.size());
    Time plain;
    const auto add = [&](const char* name, double bytes, const Time& time) {
        const double rate = bytes / (1e-3 * time.wall_ms);
        report.row({name, fixed(bytes / 1048576.0, 0), fixed(time.cpu_ms, 1),
                    fixed(time.wall_ms, 1), fixed(plain.cpu_ms / time.cpu_ms, 2),
                    fixed(plain.wall_ms / time.wall_ms, 2), fixed(rate / kGigabyte, 2),
                    fixed(100.0 * rate / copy, 0)});
    };
    for (const auto& [code, name] :
         {std::pair{Code::float32, "float"}, std::pair{Code::float16, "half"},
          std::pair{Code::log8, "8-bit logarithm"}, std::pair{Code::bc4, "BC4"},
          std::pair{Code::bc1, "BC1"}}) {
        const CodedMatrix matrix = random_matrix(code, n);
        if (code == Code::float32) {
            RowByRow simple(device, matrix);
            plain = time_of(device, settings.repeats,
                            [&](gpu::Commands& commands) { simple.record(commands, in, out); });
            add("float, a group for each row", double(matrix.bytes()), plain);
        }
        RowsProduct product(device, code, std::span(matrix.words).first(is_bc1(code) ? 1 : 3), n, n,
                            {.offset = matrix.decoding.offset});
        add(name, double(matrix.bytes()),
            time_of(device, settings.repeats, [&](gpu::Commands& commands) {
                product.record(commands, in, out, filled_up(n), 1);
            }));
        if (code != Code::bc1 || !device.can_read_blocks() || n > device.max_image_side())
            continue;
        const std::vector<glm::vec3> white(n, glm::vec3(1.0f));
        const gpu::Array<glm::vec3> x(device, std::span<const glm::vec3>(white)), y(device, n);
        MultiplyBc1 texture(device, {matrix.decoding, matrix.words[0]}, 1);
        add("BC1, texture", double(matrix.bytes()),
            time_of(device, settings.repeats,
                    [&](gpu::Commands& commands) { texture.record(commands, x, y, 1); }));
    }
}

}  // namespace

void time_matrices(const MatrixSpeedSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    report.say(words_of(device));
    add_against_naive(report, device,
                      make_matrix_case(device, settings.shared, std::uint32_t(settings.patches), 1),
                      settings);
    add_frame(report, device, settings);
    if (!settings.growth.empty())
        add_growth(report, device, settings);
    if (settings.large > 0)
        add_large(report, device, settings);
}

}  // namespace lumel::bench
