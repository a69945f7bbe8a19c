#pragma once
// What a figure has to show: lines, tables and pictures.

#include <concepts>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gpu/device.h"

namespace lumel::bench {

/// What stands in a place of a table, and the number behind it if it is one.
struct Cell {
    Cell(const char* words) : text(words) {}
    Cell(std::string words) : text(std::move(words)) {}
    Cell(std::integral auto count) : text(std::to_string(count)), value(double(count)) {}
    Cell(std::string words, double number) : text(std::move(words)), value(number) {}

    std::string text;
    std::optional<double> value;
};

Cell fixed(double value, int decimals);         ///< "3.14"
Cell signed_fixed(double value, int decimals);  ///< "+3.14"
Cell significant(double value, int digits);     ///< "3.14e-05"
Cell none();                                    ///< "–": was not measured

/// Last column of each table.
inline constexpr const char* kOurDefault = "our default";
/// Reasons why it has no cell.
inline constexpr const char *kNoMatrix = "no matrix", *kNoShooters = "no shooters",
                            *kTracesRays = "traces rays", *kSolvedAnew = "solved anew";

struct Table {
    std::string key;                   ///< by which the papers' numbers find it, unique in a report
    std::string title;                 ///< what it shows; where a paper does, its figure or table
    std::vector<std::string> columns;  ///< kOurDefault last
    std::vector<std::vector<Cell>> rows;
};

struct Picture {
    std::string path;
    std::string caption;
};

/// Prints each part to stdout, as Markdown, as soon as it is there, and keeps it.
class Report {
public:
    using Part = std::variant<std::string, Table, Picture>;

    /// A line: scene, device, settings.
    void say(std::string line);
    /// Begins a table, to which row() adds. ours: of our default method for the same scene, in the
    /// last column of all rows that have no other; or two words that say why it has none.
    void table(std::string key, std::string title, std::vector<std::string> columns, Cell ours);
    /// As many cells as columns. Throws std::logic_error otherwise.
    void row(std::vector<Cell> cells);
    void row(std::vector<Cell> cells, Cell ours);
    void picture(std::string path, std::string caption);

    const std::vector<Part>& parts() const { return parts_; }
    /// Nothing if there is none of this key.
    const Table* find(const std::string& key) const;

private:
    std::vector<Part> parts_;
    Cell ours_ = none();  ///< of the current table
};

/// "llvmpipe (…) (driver)"
std::string words_of(const gpu::Device& device);

/// A processor as the device has other work beside the figures, which lengthens wall time: there
/// processor time is what ratios are of.
bool counts_processor_time(const gpu::Device& device);

/// In the first row whose leading cells, joined by ", ", are `row`; nothing if the table has no
/// such row or column.
const Cell* cell_at(const Table& table, const std::string& row, const std::string& column);

}  // namespace lumel::bench
