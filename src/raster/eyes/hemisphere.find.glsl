#ifndef LUMEL_VISIBILITY_HEMISPHERE_FIND_GLSL
#define LUMEL_VISIBILITY_HEMISPHERE_FIND_GLSL

// Finds the triangle of a piece or patch by a binary search in the running counts, so that no list
// is needed. Declares the counts. Params must contain a LookParams p.

#include "raster/eyes/hemisphere.shared.h"

layout(scalar) readonly buffer Counts { CutCount counts[]; };
layout(scalar) readonly buffer BlockCounts { CutCount block_counts[]; };

struct Found {
    uint triangle;  // in the range
    uint number;    // piece in its triangle
};

uint chosen(CutCount count, bool patches)
{
    return patches ? count.patches : count.pieces;
}

Found find_triangle(uint number, bool patches)
{
    uint block = 0u;  // the last block that begins at or before `number`
    for (uint end = p.blocks; block + 1u < end;) {
        const uint middle = (block + end) / 2u;
        if (chosen(block_counts[p.first_block + middle], patches) <= number)
            block = middle;
        else
            end = middle;
    }
    number -= chosen(block_counts[p.first_block + block], patches);
    const uint slot = (p.first_block + block) * kCutBlock;
    uint found = 0u;  // the first triangle that ends after `number`
    for (uint step = kCutBlock / 2u; step > 0u; step /= 2u)
        if (chosen(counts[slot + found + step - 1u], patches) <= number)
            found += step;
    const uint before = found > 0u ? chosen(counts[slot + found - 1u], patches) : 0u;
    return Found(block * kCutBlock + found, number - before);
}

#endif
