#pragma once
// EXR and PNG files.

#include <map>
#include <string>

#include "core/image.h"

namespace lumel {

enum class Precision { float32, float16 };

/// ZIP-compressed scanline EXR, channels R G B (A), with string attributes for `metadata`
/// (units, encoding, …). The same input gives the same bytes. Throws Error{output}.
void write_exr(const std::string& path, const Image& image, Precision precision,
               const std::map<std::string, std::string>& metadata);

/// Reads R, G, B and, if there, A (else 1) as 4 channels. Throws Error{input}.
Image read_exr(const std::string& path);

/// 8-bit PNG of an image whose values are display-referred 0…1 (already tone-mapped and
/// sRGB-coded). 3 or 4 channels. Throws Error{output}.
void write_png(const std::string& path, const Image& image);

/// The same PNG in memory.
std::vector<unsigned char> encode_png(const Image& image);

/// Tone-mapped copy for looking at: exposure from the map's bright end, filmic shoulder, sRGB.
/// `exposure` 0: chosen from the covered texels.
Image tone_map(const Image& linear, float exposure = 0.0f);

}  // namespace lumel
