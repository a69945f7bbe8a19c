#pragma once
// Numbers drawn into images.

#include <string_view>

#include <glm/glm.hpp>

#include "base/core/image.h"

namespace lumel {

/// Size [pixels] of a text of digits, '.', 'l', 'x', '%' and spaces, magnified by `scale`.
glm::ivec2 text_size(std::string_view text, int scale);

/// Draws `text` with its top left corner at `at`, clipped to the image.
void draw_text(Image& image, const glm::ivec2& at, std::string_view text, int scale,
               const glm::vec3& color);

}  // namespace lumel
