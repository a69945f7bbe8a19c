#ifndef LUMEL_MATRIX_LOG_CODE_GLSL
#define LUMEL_MATRIX_LOG_CODE_GLSL

// From codes 0…255 to entries of a matrix.

#include "solve/matrix/log_code.shared.h"

vec4 from_log_codes(vec4 codes, float log_step, float log_factor)
{
    const vec4 entries = exp2(codes * log_step + log_factor);
    return mix(entries, vec4(0.0), lessThan(codes, vec4(kMinLogCode)));
}

#endif
