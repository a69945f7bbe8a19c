#pragma once
// EXR, PNG and KTX2 files.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/core/image.h"

namespace lumel {

enum class Precision { float32, float16 };

/// An image beside the main one in an EXR: its channels are name.R, name.G and name.B.
struct Layer {
    std::string name;  ///< may have dots, which viewers show as folders
    Image image;       ///< as large as the main one; a fourth channel is not written
};

/// ZIP-compressed scanline EXR, channels R G B (A) and those of the layers, with string attributes
/// for `metadata` (units, encoding, …). float16 clamps to ±65504. The same input gives the same
/// bytes: no date is written. Throws Error{output}.
void write_exr(const std::string& path, const Image& image, Precision precision,
               const std::map<std::string, std::string>& metadata,
               std::span<const Layer> layers = {});

/// Reads R, G, B and, if there, A (else 1) of a layer as 4 channels; layer "": of the main image,
/// whatever layers there are. Throws Error{input}.
Image read_exr(const std::string& path, const std::string& layer = "");

/// What the numbers of a PNG mean, as its header states.
enum class PngEncoding { srgb, linear };

/// 8-bit PNG of an image whose values are display-referred 0…1 (already tone-mapped and
/// sRGB-coded). 3 or 4 channels. Throws Error{output}.
void write_png(const std::string& path, const Image& image);

/// The same PNG in memory. Values outside 0…1 are clamped.
std::vector<unsigned char> encode_png(const Image& image, PngEncoding encoding = PngEncoding::srgb);

/// PNG in memory of 8-bit RGBA as it is [height][width][4], without alpha where all is opaque.
/// Throws Error{output}.
std::vector<unsigned char> encode_png(std::span<const std::uint8_t> rgba, int width, int height);

/// How a texel of a KTX2 file holds RGB.
enum class FloatTexel {
    half,             ///< three half floats and a fourth of 1: 8 bytes, 0.05 % [VK_FORMAT 97]
    shared_exponent,  ///< 9 bits each and one exponent: 4 bytes, 0.2 % of the largest [123]
};

/// KTX2 file in memory: linear Rec. 709, no mipmaps, compressed by Zstandard, the first row on top.
/// What a texel cannot hold stays at its largest number (65504 or 65408) or at 0. 3 or 4 channels,
/// of which the fourth is not written. Throws Error{output}.
std::vector<unsigned char> encode_ktx2(const Image& image, FloatTexel texel);

/// Tone-mapped copy for looking at: exposure from the map's bright end, filmic shoulder, sRGB.
/// `exposure` 0: chosen from the covered texels. Alpha stays as it is.
Image tone_map(const Image& linear, float exposure = 0.0f);

/// Luminance that is bright in this image, in its own unit: the 98th percentile of the covered,
/// lit texels, but no more than 8 times their median, which takes lamps for lamps. 0: nothing lit.
float bright_end(const Image& linear);

/// The factor tone_map chooses: it puts the bright end just below white. 1 if nothing is lit.
float choose_exposure(const Image& linear);

/// tone_map's curve for one value that exposure was applied to: display code 0…1.
float display_from_linear(float exposed);

/// The exact sRGB curve (IEC 61966-2-1): linear 0…1 to code 0…1.
float srgb_from_linear(float linear);

/// Of the libraries that write EXR, PNG and KTX2: "3.1.5".
std::string openexr_version();
std::string libpng_version();
std::string zstd_version();

}  // namespace lumel
