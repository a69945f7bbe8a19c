#!/usr/bin/env python3
"""Makes a room of numpy arrays, bakes it, and writes FOLDER/room.glb.

    python3 room_in_numpy.py FOLDER
"""

import pathlib
import sys

import lumel
import numpy as np


def quad(corner: list[float], u: list[float], v: list[float], material: int) -> lumel.Primitive:
    """Faces u × v."""
    at, along, up = np.array(corner), np.array(u), np.array(v)
    return lumel.Primitive(positions=np.stack([at, at + along, at + along + up, at + up]),
                           indices=[[0, 1, 2], [0, 2, 3]], material=material)


def room() -> lumel.Scene:
    """4 × 3 × 5 m, with a lamp below the ceiling."""
    white, red, lamp = 0, 1, 2
    walls = lumel.Mesh([
        quad([0, 0, 0], [0, 0, 5], [4, 0, 0], white), quad([0, 3, 0], [4, 0, 0], [0, 0, 5], white),
        quad([0, 0, 0], [4, 0, 0], [0, 3, 0], white), quad([0, 0, 5], [0, 3, 0], [4, 0, 0], white),
        quad([0, 0, 0], [0, 3, 0], [0, 0, 5], red), quad([4, 0, 0], [0, 0, 5], [0, 3, 0], white)], "walls")
    light = lumel.Mesh([quad([0, 0, 0], [1, 0, 0], [0, 0, 1], lamp)], "lamp")
    above = np.eye(4)
    above[:3, 3] = [1.5, 2.9, 2.0]
    return lumel.Scene(
        meshes=[walls, light],
        instances=[lumel.Instance(mesh=0, name="walls"), lumel.Instance(mesh=1, name="lamp", transform=above)],
        materials=[lumel.Material("white", base_color=(.7, .7, .7, 1)), lumel.Material("red", base_color=(.6, .1, .1, 1)),
                   lumel.Material("lamp", base_color=(0, 0, 0, 1), emitted=(1000, 1000, 900))])


def tell(now: lumel.Progress) -> None:
    print(f"\r{now.stage:20} {100 * now.fraction:3.0f} %", end="", file=sys.stderr)


def main(folder: pathlib.Path) -> None:
    baked = lumel.bake(room(), size=256, progress=tell)
    height, width, _ = baked.map.shape
    # The floor is the first surface: its texels are those around its coordinates.
    low, high = (size * np.array([width, height]) for size in
                 (baked.surfaces[0].lightmap.min(axis=0), baked.surfaces[0].lightmap.max(axis=0)))
    floor = baked.map[round(low[1]):round(high[1]), round(low[0]):round(high[0]), :3]
    print(f"\n{width} x {height} texels in {baked.seconds:.1f} s, mean {floor.mean():.1f} lx on the floor, "
          f"error {100 * baked.error:.1f} %")
    lumel.write_scene(folder / "room.glb", baked)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
