#pragma once
// Numbers written into pictures.

#include <string_view>

#include <glm/glm.hpp>

#include "base/core/image.h"

namespace lumel {

/// Size of a text of digits, '.', 'l', 'x', '%' and spaces, each pixel of which is scale × scale
/// pixels.
glm::ivec2 text_size(std::string_view text, int scale);

/// Writes it with its top left corner at `at`; what lies outside of the image is left out.
void draw_text(Image& image, const glm::ivec2& at, std::string_view text, int scale,
               const glm::vec3& color);

}  // namespace lumel
