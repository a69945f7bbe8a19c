#include "base/images/digits.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace lumel {
namespace {

constexpr int kWidth = 5, kHeight = 7;  ///< glyph size [pixels]
constexpr int kAdvance = kWidth + 1;    ///< distance between glyphs

/// Rows from the top, five bits each, the left pixel first.
using Glyph = std::array<std::uint8_t, kHeight>;

constexpr std::array<Glyph, 10> kDigits = {{
    {0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110},
    {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110},
    {0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111},
    {0b11111, 0b00010, 0b00100, 0b00010, 0b00001, 0b10001, 0b01110},
    {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010},
    {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110},
    {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110},
    {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000},
    {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110},
    {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100},
}};
constexpr Glyph kPoint = {0, 0, 0, 0, 0, 0b01100, 0b01100};
constexpr Glyph kL = {0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110};
constexpr Glyph kX = {0, 0, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001};
constexpr Glyph kPercent = {0b11000, 0b11001, 0b00010, 0b00100, 0b01000, 0b10011, 0b00011};

Glyph glyph_of(char letter)
{
    if (letter >= '0' && letter <= '9')
        return kDigits[std::size_t(letter - '0')];
    switch (letter) {
    case '.':
        return kPoint;
    case 'l':
        return kL;
    case 'x':
        return kX;
    case '%':
        return kPercent;
    default:
        return {};
    }
}

void fill(Image& image, const glm::ivec2& low, const glm::ivec2& size, const glm::vec3& color)
{
    for (int y = std::max(low.y, 0); y < std::min(low.y + size.y, image.height); ++y)
        for (int x = std::max(low.x, 0); x < std::min(low.x + size.x, image.width); ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y)[c] = color[c];
}

}  // namespace

glm::ivec2 text_size(std::string_view text, int scale)
{
    return scale * glm::ivec2(std::max(int(text.size()) * kAdvance - 1, 0), kHeight);
}

void draw_text(Image& image, const glm::ivec2& at, std::string_view text, int scale,
               const glm::vec3& color)
{
    for (std::size_t letter = 0; letter < text.size(); ++letter) {
        const Glyph glyph = glyph_of(text[letter]);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                if (glyph[std::size_t(y)] >> (kWidth - 1 - x) & 1)
                    fill(image, at + scale * glm::ivec2(int(letter) * kAdvance + x, y),
                         glm::ivec2(scale), color);
    }
}

}  // namespace lumel
