#pragma once
// EXR, PNG and KTX2 files.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/core/image.h"

namespace lumel {

enum class Precision { float32, float16 };

/// An additional image in an EXR file, with channels name.R, name.G and name.B.
struct Layer {
    std::string name;  ///< may have dots, which viewers show as folders
    Image image;       ///< same size as the main image; a fourth channel is not written
};

/// Writes a ZIP-compressed scanline EXR with channels R G B (A) and those of the layers, and
/// `metadata` as string attributes (units, encoding, …). float16 clamps to ±65504. Equal input
/// gives equal bytes: no date is written. Throws Error{output}.
void write_exr(const std::string& path, const Image& image, Precision precision,
               const std::map<std::string, std::string>& metadata,
               std::span<const Layer> layers = {});

/// Reads R, G, B and A (1 if absent) of a layer as 4 channels. layer "": the main image. Throws
/// Error{input}.
Image read_exr(const std::string& path, const std::string& layer = "");

/// The same; empty if the file has no such layer.
std::optional<Image> find_exr_layer(const std::string& path, const std::string& layer);

/// Transfer function of a PNG, as its header declares it.
enum class PngEncoding { srgb, linear };

/// Writes an 8-bit PNG of display-referred values 0…1 (tone-mapped and sRGB-coded). 3 or 4
/// channels. Throws Error{output}.
void write_png(const std::string& path, const Image& image);

/// Encodes such a PNG in memory. Clamps values to 0…1.
std::vector<unsigned char> encode_png(const Image& image, PngEncoding encoding = PngEncoding::srgb);

/// Encodes 8-bit RGBA [height][width][4] as PNG in memory, without alpha if all is opaque. Throws
/// Error{output}.
std::vector<unsigned char> encode_png(std::span<const std::uint8_t> rgba, int width, int height);

/// Texel format of a KTX2 file.
enum class FloatTexel {
    half,             ///< three half floats and a fourth of 1: 8 bytes, 0.05 % [VK_FORMAT 97]
    shared_exponent,  ///< 9 bits each and one exponent: 4 bytes, 0.2 % of the largest [123]
};

/// Encodes a KTX2 file in memory: linear Rec. 709, no mipmaps, Zstandard, top row first. Clamps to
/// 0…65504 (half) or 0…65408. 3 or 4 channels; the fourth is not written. Throws Error{output}.
std::vector<unsigned char> encode_ktx2(const Image& image, FloatTexel texel);

/// Factor that exposes linear light for tone_curve(): the log-average of covered, lit pixels
/// becomes mid grey or, in bright images, up to one stop more. Lamps that cover less than 5 % do
/// not count. Empty if nothing is lit.
std::optional<float> choose_exposure(const Image& linear);

/// Copy for display: exposure, AgX tone curve, sRGB. Alpha is unchanged.
Image tone_map(const Image& linear, float exposure);

/// Tone-maps with the exposure of choose_exposure(), or 1 if nothing is lit.
Image tone_map(const Image& linear);

/// Versions of the libraries that write EXR, PNG and KTX2: "3.1.5".
std::string openexr_version();
std::string libpng_version();
std::string zstd_version();

}  // namespace lumel
