#include "bench/papers/report.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

namespace lumel::bench {
namespace {

/// A bar in a cell would end it.
std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '|')
            result += '\\';
        result += c;
    }
    return result;
}

bool leads_to(const std::vector<Cell>& cells, const std::string& row)
{
    std::string joined;
    for (const Cell& cell : cells) {
        joined += (joined.empty() ? "" : ", ") + cell.text;
        if (joined == row)
            return true;
    }
    return false;
}

}  // namespace

Cell fixed(double value, int decimals)
{
    return {fmt::format("{:.{}f}", value, decimals), value};
}

Cell signed_fixed(double value, int decimals)
{
    return {fmt::format("{:+.{}f}", value, decimals), value};
}

Cell significant(double value, int digits)
{
    return {fmt::format("{:.{}g}", value, digits), value};
}

Cell none()
{
    return "–";
}

void Report::say(std::string line)
{
    fmt::print("\n{}\n", line);
    std::fflush(stdout);
    parts_.emplace_back(std::move(line));
}

void Report::table(std::string key, std::string title, std::vector<std::string> columns, Cell ours)
{
    ours_ = std::move(ours);
    columns.emplace_back(kOurDefault);
    fmt::print("\n{}\n\n|", title);
    for (const std::string& column : columns)
        fmt::print(" {} |", escaped(column));
    fmt::print("\n|");
    for (std::size_t i = 0; i < columns.size(); ++i)
        fmt::print("---|");
    fmt::print("\n");
    std::fflush(stdout);
    parts_.emplace_back(Table{std::move(key), std::move(title), std::move(columns), {}});
}

void Report::row(std::vector<Cell> cells)
{
    row(std::move(cells), ours_);
}

void Report::row(std::vector<Cell> cells, Cell ours)
{
    cells.push_back(std::move(ours));
    auto* table = parts_.empty() ? nullptr : std::get_if<Table>(&parts_.back());
    if (!table || cells.size() != table->columns.size())
        throw std::logic_error("a row that fits no table");
    fmt::print("|");
    for (const Cell& cell : cells)
        fmt::print(" {} |", escaped(cell.text));
    fmt::print("\n");
    std::fflush(stdout);
    table->rows.push_back(std::move(cells));
}

void Report::picture(std::string path, std::string caption)
{
    fmt::print("\n![{}]({})\n", caption, path);
    std::fflush(stdout);
    parts_.emplace_back(Picture{std::move(path), std::move(caption)});
}

const Table* Report::find(const std::string& key) const
{
    for (const Part& part : parts_)
        if (const auto* table = std::get_if<Table>(&part); table && table->key == key)
            return table;
    return nullptr;
}

std::string words_of(const gpu::Device& device)
{
    return fmt::format("{} ({})", device.info().name, device.info().driver);
}

bool counts_processor_time(const gpu::Device& device)
{
    return device.info().type == "cpu";
}

const Cell* cell_at(const Table& table, const std::string& row, const std::string& column)
{
    const auto place = std::find(table.columns.begin(), table.columns.end(), column);
    if (place == table.columns.end())
        return nullptr;
    for (const std::vector<Cell>& cells : table.rows)
        if (leads_to(cells, row))
            return &cells[std::size_t(place - table.columns.begin())];
    return nullptr;
}

}  // namespace lumel::bench
