#include "bench/papers/contact_sheet.h"

#include <algorithm>

namespace lumel::bench {

Image contact_sheet(const std::vector<std::vector<Image>>& rows)
{
    const Image& first = rows.front().front();
    const auto& longest = *std::max_element(
        rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    Image sheet(first.width * int(longest.size()), first.height * int(rows.size()), first.channels);
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t column = 0; column < rows[row].size(); ++column) {
            const Image& picture = rows[row][column];
            for (int y = 0; y < picture.height; ++y)
                std::copy_n(picture.at(0, y), picture.width * picture.channels,
                            sheet.at(int(column) * picture.width, int(row) * picture.height + y));
        }
    return sheet;
}

}  // namespace lumel::bench
