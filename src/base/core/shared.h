#ifndef LUMEL_BASE_CORE_SHARED_H
#define LUMEL_BASE_CORE_SHARED_H

// The one header that both compilers read. A *.shared.h file includes it first, then declares
// plain structs and constants; C++ and GLSL see the same names, order and offsets (scalar block
// layout: every member sits at its natural C offset, a vec3 is 12 bytes, there is no padding).

// clang-format off
#ifdef __cplusplus

#include <cstdint>
#include <glm/glm.hpp>

#define LUMEL_SHARED_BEGIN namespace lumel { using uint = std::uint32_t; \
                                             using glm::uvec2; using glm::vec2; using glm::vec3; \
                                             using glm::vec4; using glm::mat4;
#define LUMEL_SHARED_END   }
#define LUMEL_CONST        inline constexpr

#else

#extension GL_EXT_scalar_block_layout : require
#define LUMEL_SHARED_BEGIN
#define LUMEL_SHARED_END
#define LUMEL_CONST        const

#endif
// clang-format on

#endif
