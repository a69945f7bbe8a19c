#include "scene/gltf/files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

namespace lumel {

namespace {

namespace fs = std::filesystem;

int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string percent_decoded(const JsonView& uri, std::string_view text)
{
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0)
            uri.fail("is not a valid URI: % must be followed by two hexadecimal digits");
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

/// Base64 of RFC 4648, with or without padding.
Bytes base64_decoded(const JsonView& uri, std::string_view text)
{
    while (!text.empty() && text.back() == '=')
        text.remove_suffix(1);
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value;
    value.fill(-1);
    for (std::size_t i = 0; i < kDigits.size(); ++i)
        value[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);

    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (char c : text) {
        const int digit = value[static_cast<unsigned char>(c)];
        if (digit < 0)
            uri.fail("holds a character that is not base64");
        bits = (bits << 6) | static_cast<std::uint32_t>(digit);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count));
        }
    }
    if (bit_count == 6)
        uri.fail("holds base64 data that is cut short");
    return bytes;
}

Bytes read_data_uri(const JsonView& uri, std::string_view text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos)
        uri.fail("is not a valid data URI: it has no comma");
    const std::string_view head = text.substr(0, comma);
    const std::string_view body = text.substr(comma + 1);
    constexpr std::string_view kBase64 = ";base64";
    const bool base64 =
        head.size() >= kBase64.size() && head.substr(head.size() - kBase64.size()) == kBase64;
    if (base64 && body.find('%') == std::string_view::npos)
        return base64_decoded(uri, body);
    const std::string plain = percent_decoded(uri, body);
    return base64 ? base64_decoded(uri, plain) : Bytes(plain.begin(), plain.end());
}

/// Length of "scheme" in "scheme:…" (RFC 3986), 0 if there is none.
std::size_t scheme_length(std::string_view text)
{
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos || colon == 0 ||
        !std::isalpha(static_cast<unsigned char>(text[0])))
        return 0;
    const bool valid = std::all_of(text.begin(), text.begin() + colon, [](unsigned char c) {
        return std::isalnum(c) || c == '+' || c == '.' || c == '-';
    });
    return valid ? colon : 0;
}

bool lies_in(const fs::path& folder, const fs::path& file)
{
    const auto [end, unused] =
        std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
}

}  // namespace

Bytes read_uri(const JsonView& uri, const std::string& scene_path)
{
    const std::string_view text = uri.string();
    constexpr std::string_view kData = "data:";
    if (text.substr(0, kData.size()) == kData)
        return read_data_uri(uri, text.substr(kData.size()));
    if (const std::size_t length = scheme_length(text))
        uri.fail("has the scheme " + quoted(std::string(text.substr(0, length))) +
                 "; only files in the scene's folder and data: URIs are read");

    // The path is checked after links and ".." are resolved.
    const std::string name = percent_decoded(uri, text);
    if (name.empty() || name.find('\0') != std::string::npos)
        uri.fail("does not name a file");
    if (name.front() == '/')
        uri.fail("is an absolute path; only files in the scene's folder are read");
    std::error_code error;
    const fs::path folder = fs::canonical(fs::absolute(scene_path).parent_path(), error);
    const fs::path file = error ? fs::path() : fs::weakly_canonical(folder / name, error);
    if (error)
        uri.fail("names the file " + quoted(name) + ", which cannot be found");
    if (!lies_in(folder, file))
        uri.fail("names " + quoted(name) + ", which lies outside the scene's folder");
    return read_file(file.string(), uri.place() + ": the file " + quoted(name));
}

}  // namespace lumel
