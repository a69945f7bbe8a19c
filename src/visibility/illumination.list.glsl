// The lists of an illumination map that keeps all surfaces. The includer declares `uint heads[]`,
// `Fragment fragments[]` and `FragmentCount total`, and includes parallel.glsl.

// Puts a surface in front of the pixel's list, if there is room.
void append(IlluminationParams p, uint surface)
{
    const uint index = atomicAdd(total.count, 1u);
    if (index >= total.capacity) {
        atomicMax(total.most, index + 1u);
        return;
    }
    const uint side = p.layout_.side;
    const uvec2 pixel = uvec2(gl_FragCoord.xy) - tile_corner(p.layout_, p.tile);
    const uint head = (p.tile * side + pixel.y) * side + pixel.x;
    fragments[index] = Fragment(surface, gl_FragCoord.z, atomicExchange(heads[head], index));
}
