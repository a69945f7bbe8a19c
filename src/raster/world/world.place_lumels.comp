#version 460
#include "raster/world/world.shared.h"

// Transforms lumels and their pieces to the world: points by the instance's transform, normals by
// its inverse transpose. A mirroring transform also swaps the edges of a piece, so that
// cross(edge_u, edge_v) still points to the lumel's side.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Placements { Placement placements[]; };
layout(scalar) readonly buffer LocalLumels { Lumel local_lumels[]; };
layout(scalar) readonly buffer LocalPieces { Piece local_pieces[]; };
layout(scalar) writeonly buffer Lumels { Lumel lumels[]; };
layout(scalar) writeonly buffer Pieces { Piece pieces[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    Lumel lumel = local_lumels[i];
    const mat4 frame = placements[lumel.instance].now;
    const mat3 linear = mat3(frame);
    const mat3 normals = transpose(inverse(linear));
    const bool mirrored = determinant(linear) < 0.0;

    lumel.position = (frame * vec4(lumel.position, 1.0)).xyz;
    lumel.normal = normalize(normals * lumel.normal);
    lumels[i] = lumel;

    for (uint k = lumel.first_piece; k < lumel.first_piece + lumel.piece_count; ++k) {
        Piece piece = local_pieces[k];
        const vec3 u = linear * piece.edge_u;
        const vec3 v = linear * piece.edge_v;
        piece.origin = (frame * vec4(piece.origin, 1.0)).xyz;
        piece.edge_u = mirrored ? v : u;
        piece.edge_v = mirrored ? u : v;
        piece.normal = normalize(normals * piece.normal);
        pieces[k] = piece;
    }
}
