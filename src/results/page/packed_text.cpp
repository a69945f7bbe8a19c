#include "results/page/packed_text.h"

#include "results/files/gzip.h"

namespace lumel {
namespace {

std::string base64(std::span<const std::uint8_t> bytes)
{
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr int kBits = 6;  // per digit
    constexpr std::uint32_t kMask = (1u << kBits) - 1;
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
        std::uint32_t group = 0;
        for (std::size_t byte = 0; byte < 3; ++byte)
            group = group << 8 | (byte < left ? bytes[i + byte] : 0u);
        for (std::size_t digit = 0; digit < 4; ++digit)
            text += digit <= left ? kDigits[group >> (kBits * int(3 - digit)) & kMask] : '=';
    }
    return text;
}

}  // namespace

std::string packed_text(std::span<const std::uint8_t> bytes)
{
    return base64(gzip(bytes));
}

}  // namespace lumel
