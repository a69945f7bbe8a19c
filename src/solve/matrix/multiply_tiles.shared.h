#ifndef LUMEL_SOLVE_MATRIX_MULTIPLY_TILES_SHARED_H
#define LUMEL_SOLVE_MATRIX_MULTIPLY_TILES_SHARED_H
#include "solve/matrix/tiles.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kTileGroup = 64u;
LUMEL_CONST uint kTileLanes = 8u;  ///< invocations that share a row of tiles

/// Push constants of multiply_tiles.*.comp.
struct TileParams {
    uint clusters;
    uint states;
    float unit;  ///< what a half float 1 means in a tile
};

LUMEL_SHARED_END
#endif
