#include "viewer/session/solve_order.h"

#include <array>
#include <cmath>
#include <optional>

#include "base/core/error.h"
#include "base/core/number.h"

namespace lumel {
namespace {

constexpr double kPercentOf = 100.0;
constexpr double kMaxShots = 1e15;  ///< largest count without gaps in doubles

/// A limit of a solve, common to all methods.
struct Limit {
    const char *name, *range;
    bool whole;
    void (*set)(SolverOptions& options, double value);
};

constexpr std::array kLimits = {
    Limit{"error", "a number above 0", false,
          [](SolverOptions& options, double value) { options.target_error = value / kPercentOf; }},
    Limit{"dark-error", "a number above 0", false,
          [](SolverOptions& options, double value) {
              options.target_dark_error = value / kPercentOf;
          }},
    Limit{"shots", "a whole number from 1 on", true,
          [](SolverOptions& options, double value) { options.max_shots = std::uint64_t(value); }},
    Limit{"time", "a number above 0", false,
          [](SolverOptions& options, double value) { options.max_seconds = value; }},
};

/// Returns false if it is not a limit.
bool take_limit(SolverOptions& options, const std::string& name, const std::string& text)
{
    for (const Limit& limit : kLimits) {
        if (name != limit.name)
            continue;
        const std::optional<double> value = number_of(text);
        const bool fits = value && std::isfinite(*value) && *value > 0.0 && *value < kMaxShots &&
                          !(limit.whole && *value != std::floor(*value));
        if (!fits)
            throw Error(ErrorKind::input, "--" + name + " " + text,
                        std::string("must be ") + limit.range);
        limit.set(options, *value);
        return true;
    }
    return false;
}

SolverOptions order_of(std::span<const std::string> words)
{
    GivenMethod given;
    given.id = words.empty() ? std::string() : words.front();
    method_of(given.id);  // throws for an unknown name, and lists the methods
    SolverOptions options;
    options.target_error = 0.0;
    for (std::size_t w = 1; w < words.size(); w += 2) {
        const std::string& word = words[w];
        if (!word.starts_with("--"))
            throw Error(ErrorKind::input, word, "is not an option; options begin with --");
        if (w + 1 == words.size())
            throw Error(ErrorKind::input, word, "needs a value");
        if (const std::string name = word.substr(2); !take_limit(options, name, words[w + 1]))
            given.values[name] = words[w + 1];
    }
    options.method = given.options();
    const bool has_limit =
        options.has_target() || options.max_shots > 0 || options.max_seconds > 0.0;
    if (!has_limit)
        options.target_error = SolverOptions{}.target_error;
    check_limits(options);
    return options;
}

}  // namespace

SolverOptions solve_order(std::span<const std::string> words, const std::string& place)
{
    try {
        return order_of(words);
    } catch (const Error& error) {
        throw Error(ErrorKind::input, place, error.what());
    }
}

}  // namespace lumel
