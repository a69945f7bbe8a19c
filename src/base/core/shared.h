#ifndef LUMEL_BASE_CORE_SHARED_H
#define LUMEL_BASE_CORE_SHARED_H

// Included first by every *.shared.h file, for C++ and GLSL. Those files declare plain structs and
// constants, and functions of them, with the same names, order and offsets in both (scalar block
// layout: every member at its natural C offset, a vec3 is 12 bytes, no padding).

// clang-format off
#ifdef __cplusplus

#include <cstdint>
#include <glm/glm.hpp>

#define LUMEL_SHARED_BEGIN namespace lumel { using uint = std::uint32_t; \
                                             using glm::uvec2; using glm::vec2; using glm::vec3; \
                                             using glm::vec4; using glm::mat3; \
                                             using glm::mat4;
#define LUMEL_SHARED_END   }
#define LUMEL_CONST        inline constexpr
#define LUMEL_FUNCTION     inline

#else

#extension GL_EXT_scalar_block_layout : require
#define LUMEL_SHARED_BEGIN
#define LUMEL_SHARED_END
#define LUMEL_CONST        const
#define LUMEL_FUNCTION

#endif
// clang-format on

#endif
