#ifndef LUMEL_PROGRESSIVE_VISIBILITY_ROWS_GLSL
#define LUMEL_PROGRESSIVE_VISIBILITY_ROWS_GLSL

// V of patches and lumels when the patch last rendered its view: one bit per pair. 32 patches share
// a word of a lumel, which only the lumel's own invocation writes. Declares the rows of a list of
// patches and the bits.

#include "methods/progressive/visibility_rows.shared.h"

layout(scalar) readonly buffer RowOf { uint row_of[]; };   // [list] row, or kNoRow
layout(scalar) buffer Seen { uint seen[]; };               // [rows / 32][N]

bool was_seen(uint row, uint lumel, uint count)
{
    return (seen[row / kRowsInAWord * count + lumel] & (1u << (row % kRowsInAWord))) != 0u;
}

void keep_seen(uint row, uint lumel, uint count, bool is_seen_now)
{
    const uint word = row / kRowsInAWord * count + lumel, bit = 1u << (row % kRowsInAWord);
    seen[word] = is_seen_now ? seen[word] | bit : seen[word] & ~bit;
}

#endif
