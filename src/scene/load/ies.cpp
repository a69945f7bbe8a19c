// IES LM-63 according to ANSI/IES LM-63-19 and its predecessors: lines of text up to TILT=, then
// numbers, distributed over any number of lines:
//     lamps  lumens-per-lamp  multiplier  V  H  type  units  width  length  height
//     ballast-factor  second-factor  watts
//     V vertical angles, H horizontal angles, and for each of these V values in candela
//
// Type C angles: vertical 0° is the nadir, 180° the zenith. Horizontal angles end at 0° for
// rotational symmetry, at 90° or 180° for mirror symmetry, else at 360°.

#include "scene/load/ies.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/core/error.h"
#include "base/core/number.h"
#include "base/json/json_view.h"

namespace lumel {
namespace {

constexpr int kMaxAngles = 10000;  ///< finer than hundredths of a degree is not useful

/// The words of a text with their lines. Commas are blanks.
class Words {
public:
    Words(std::string_view text, const std::string& place) : text_(text), place_(place) {}

    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error(ErrorKind::input, place_ + ": line " + std::to_string(line_), what);
    }

    bool at_end() const { return at_ >= text_.size(); }

    /// The rest of this line.
    std::string_view next_line()
    {
        line_ += begun_;
        begun_ = true;
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        const std::string_view line = text_.substr(at_, end - at_);
        at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
        return line;
    }

    /// The next word on this or a later line; empty at the end.
    std::string_view next()
    {
        while (position_ >= line_text_.size() && !at_end()) {
            line_text_ = next_line();
            position_ = std::min(line_text_.find_first_not_of(kBlanks), line_text_.size());
        }
        const std::size_t end =
            std::min(line_text_.find_first_of(kBlanks, position_), line_text_.size());
        const std::string_view word = line_text_.substr(position_, end - position_);
        position_ = std::min(line_text_.find_first_not_of(kBlanks, end), line_text_.size());
        return word;
    }

    double number(const char* what)
    {
        const std::string_view word = next();
        if (word.empty())
            fail(std::string("the file ends before its ") + what);
        const std::optional<double> value = number_of(word);
        if (!value)
            fail(quoted(std::string(word)) + " is not a number, but the " + what + " must be");
        return *value;
    }

    int count(const char* what)
    {
        const double value = number(what);
        if (!(value >= 1.0 && value <= kMaxAngles && value == std::floor(value)))
            fail(std::string("the ") + what + " must be a whole number from 1 to " +
                 std::to_string(kMaxAngles));
        return int(value);
    }

    double positive(const char* what)
    {
        const double value = number(what);
        if (value < 0.0)
            fail(std::string("the ") + what + " is below 0");
        return value;
    }

private:
    static constexpr const char* kBlanks = " \t,\f\v\x1A";  // DOS files end with 1A

    std::string_view text_;
    const std::string& place_;
    std::size_t at_ = 0;
    int line_ = 1;
    bool begun_ = false;  ///< a line was read
    std::string_view line_text_;
    std::size_t position_ = 0;
};

std::string_view trimmed(std::string_view text)
{
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const std::size_t end = text.find_last_not_of(" \t");
    return text.substr(begin, end == std::string_view::npos ? 0 : end + 1 - begin);
}

struct Table {
    std::vector<double> vertical;    ///< [V] degrees
    std::vector<double> horizontal;  ///< [H] degrees
    std::vector<double> candela;     ///< [H][V]
};

/// Skips the lines before the numbers. Returns true for editions in which the second factor scales
/// the candela; in later ones it is reserved or describes how the file was made.
bool skip_head(Words& words)
{
    bool both_factors = true;
    for (bool first = true; !words.at_end(); first = false) {
        const std::string_view line = trimmed(words.next_line());
        if (first && (line.starts_with("IESNA:LM-63-") || line.starts_with("IES:LM-63-")))
            both_factors = false;
        constexpr std::string_view kTilt = "TILT=";
        if (!line.starts_with(kTilt))
            continue;
        if (trimmed(line.substr(kTilt.size())) == "INCLUDE") {
            words.number("lamp's position");
            const int count = words.count("number of tilts");
            for (int i = 0; i < 2 * count; ++i)
                words.number("factors for tilted lamps");
        }
        return both_factors;
    }
    words.fail("the file ends without a line TILT=, so it is not an IES LM-63 photometric file");
}

std::vector<double> read_angles(Words& words, int count, const char* what)
{
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) {
        angles.push_back(words.number(what));
        if (i > 0 && angles.back() <= angles[std::size_t(i) - 1])
            words.fail(std::string("the ") + what + " must grow");
    }
    return angles;
}

void check_type(Words& words)
{
    const double type = words.number("photometric type");
    if (type == 2.0 || type == 3.0)
        words.fail(std::string("the photometry is of type ") + (type == 2.0 ? "B" : "A") +
                   ", which is used for floodlights and headlamps; only type C is read");
    if (type != 1.0)
        words.fail("the photometric type must be 1, which is type C");
}

void check_angles(const Words& words, const Table& table)
{
    if (table.vertical.front() < 0.0 || table.vertical.back() > 180.0 || table.vertical.size() < 2)
        words.fail("the vertical angles must be two or more from 0 to 180");
    const double first = table.horizontal.front(), last = table.horizontal.back();
    const bool from_zero =
        first == 0.0 && (last == 0.0 || last == 90.0 || last == 180.0 || last == 360.0);
    if (!from_zero && !(first == 90.0 && last == 270.0))
        words.fail("the horizontal angles must go from 0 to 0, 90, 180 or 360, or from 90 to 270");
}

Table read_table(Words& words)
{
    const bool both_factors = skip_head(words);
    words.number("number of lamps");
    words.number("lumens per lamp");
    double factor = words.positive("multiplier");
    const int verticals = words.count("number of vertical angles");
    const int horizontals = words.count("number of horizontal angles");
    check_type(words);
    words.number("unit of length");
    for (const char* size : {"width", "length", "height"})
        words.number(size);
    factor *= words.positive("ballast factor");
    const double second = words.positive("second factor");
    if (both_factors)
        factor *= second;
    words.number("watts");

    Table table;
    table.vertical = read_angles(words, verticals, "vertical angles");
    table.horizontal = read_angles(words, horizontals, "horizontal angles");
    check_angles(words, table);
    for (int i = 0; i < verticals * horizontals; ++i)
        table.candela.push_back(factor * words.positive("candela"));
    if (const std::string_view word = words.next(); !word.empty())
        words.fail(quoted(std::string(word)) +
                   " follows the last value: there are more values than angles");
    return table;
}

/// Interpolation between two of a sorted list of values.
struct Place {
    std::size_t before = 0;
    std::size_t after = 0;
    double rest = 0.0;  ///< fraction of the distance between them
};

/// Requires `value` within the range of the angles.
Place place_of(const std::vector<double>& angles, double value)
{
    const auto above = std::upper_bound(angles.begin(), angles.end(), value);
    if (above == angles.end())
        return {angles.size() - 1, angles.size() - 1, 0.0};
    const auto after = std::size_t(above - angles.begin());
    const std::size_t before = after == 0 ? 0 : after - 1;
    const double width = angles[after] - angles[before];
    return {before, after, width > 0.0 ? (value - angles[before]) / width : 0.0};
}

/// Maps a horizontal angle in [0°, 360°) to the file's range, by symmetry.
double folded(const Table& table, double angle)
{
    const double last = table.horizontal.back();
    if (table.horizontal.front() == 90.0)
        return angle < 90.0 ? 180.0 - angle : angle > 270.0 ? 540.0 - angle : angle;
    if (last == 0.0)
        return 0.0;
    if (last == 360.0)
        return angle;
    const double half = angle > 180.0 ? 360.0 - angle : angle;
    return last == 90.0 && half > 90.0 ? 180.0 - half : half;
}

/// 0 outside the file's vertical angles.
double candela_at(const Table& table, double vertical, double horizontal)
{
    if (vertical < table.vertical.front() || vertical > table.vertical.back())
        return 0.0;
    const Place v = place_of(table.vertical, vertical);
    const Place h = place_of(table.horizontal, folded(table, horizontal));
    const auto along = [&](std::size_t row) {
        const double* values = &table.candela[row * table.vertical.size()];
        return values[v.before] + v.rest * (values[v.after] - values[v.before]);
    };
    return along(h.before) + h.rest * (along(h.after) - along(h.before));
}

}  // namespace

Photometry read_ies(const Bytes& bytes, const std::string& place, const std::string& name)
{
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    Words words({text, bytes.size()}, place);
    const Table table = read_table(words);
    Photometry profile{.name = name};
    for (int a = 0; a < Photometry::kAzimuthSteps; ++a)
        for (int p = 0; p <= Photometry::kPolarSteps; ++p)
            profile.candela.push_back(float(candela_at(table, 180.0 * p / Photometry::kPolarSteps,
                                                       360.0 * a / Photometry::kAzimuthSteps)));
    return profile;
}

}  // namespace lumel
