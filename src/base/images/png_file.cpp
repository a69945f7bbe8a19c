// 8-bit PNG through libpng.

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <vector>

#include <png.h>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/images/image_files.h"

namespace lumel {
namespace {

// Three times faster than zlib's default of 6; files are 3 % larger.
constexpr int kDeflateLevel = 4;

std::vector<unsigned char> quantise(const std::vector<float>& values)
{
    // std::fmax also turns a NaN into 0.
    std::vector<unsigned char> bytes(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        bytes[i] = static_cast<unsigned char>(
            std::lround(std::fmin(std::fmax(values[i], 0.0f), 1.0f) * 255.0f));
    return bytes;
}

void append(png_structp png, png_bytep data, png_size_t count)
{
    auto& out = *static_cast<std::vector<unsigned char>*>(png_get_io_ptr(png));
    out.insert(out.end(), data, data + count);
}

// libpng's own handlers print.
[[noreturn]] void give_up(png_structp png, png_const_charp)
{
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

struct Size {
    int width;
    int height;
    int channels;
};

// No local has a destructor, because libpng leaves by longjmp. Returns false on an error of libpng.
bool encode(png_structp png, png_infop info, const unsigned char* rows, const Size& size,
            PngEncoding encoding)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_compression_level(png, kDeflateLevel);
    const int type = size.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB;
    png_set_IHDR(png, info, png_uint_32(size.width), png_uint_32(size.height), 8, type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (encoding == PngEncoding::srgb)
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    else
        png_set_gAMA(png, info, 1.0);
    png_write_info(png, info);
    const std::size_t stride = std::size_t(size.width) * std::size_t(size.channels);
    for (int y = 0; y < size.height; ++y)
        png_write_row(png, rows + std::size_t(y) * stride);
    png_write_end(png, info);
    return true;
}

std::vector<unsigned char> encode(const unsigned char* rows, const Size& size, PngEncoding encoding)
{
    std::vector<unsigned char> out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, ignore);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    bool done = false;
    if (info) {
        png_set_write_fn(png, &out, append, nullptr);
        done = encode(png, info, rows, size, encoding);
    }
    png_destroy_write_struct(&png, &info);
    if (!done)
        throw Error(ErrorKind::output, "",
                    "an image of " + std::to_string(size.width) + " x " +
                        std::to_string(size.height) + " texels cannot be encoded as PNG");
    return out;
}

}  // namespace

std::vector<unsigned char> encode_png(const Image& image, PngEncoding encoding)
{
    const std::vector<unsigned char> rows = quantise(image.values);
    return encode(rows.data(), {image.width, image.height, image.channels}, encoding);
}

std::vector<unsigned char> encode_png(std::span<const std::uint8_t> rgba, int width, int height)
{
    std::vector<unsigned char> rgb;
    bool opaque = true;
    for (std::size_t i = 0; i < rgba.size() && opaque; i += 4) {
        rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
        opaque = rgba[i + 3] == 255;
    }
    return opaque ? encode(rgb.data(), {width, height, 3}, PngEncoding::srgb)
                  : encode(rgba.data(), {width, height, 4}, PngEncoding::srgb);
}

void write_png(const std::string& path, const Image& image)
{
    const std::vector<unsigned char> bytes = encode_png(image);
    write_bytes(path, std::as_bytes(std::span(bytes)));
}

std::string libpng_version()
{
    return PNG_LIBPNG_VER_STRING;
}

}  // namespace lumel
