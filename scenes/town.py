#!/usr/bin/env python3
"""Writes a town of any size, to measure how time and memory grow: ./town.py town.gltf --blocks 20

A block is 40 m a side: its ground, four houses, twelve trees, six lamp posts and two benches, 25 nodes of nine meshes.
20 blocks a side are 10,000 nodes that show a million triangles. The same blocks always give the same file.
"""

import argparse
import math
import random

from gltf_writer import Gltf, Shape

BLOCK = 40.0  # [m]
HOUSES = ((9.0, 6.0, 11.0, 2), (12.0, 9.0, 9.0, 3), (8.0, 12.0, 14.0, 4))  # [m], and storeys
WINDOW = (0.9, 1.4, 0.12)  # width, height, depth of its frame [m]
BLIND = 0.02  # between a frame and its wall: no two faces lie on each other [m]


def windows(shape, material, size, storeys):
    """Frames before the long walls: four a storey on each."""
    width, height, depth = size
    storey = height / storeys
    for row in range(storeys):
        low = row * storey + 0.35 * storey
        for column in range(4):
            x = width * (column + 1) / 5 - WINDOW[0] / 2
            for z in (-WINDOW[2] - BLIND, depth + BLIND):
                shape.box(material, (x, low, z), (x + WINDOW[0], low + WINDOW[1], z + WINDOW[2]))


def roof(shape, material, size):
    """A ridge along x, with eaves."""
    width, height, depth = size
    a, b, eave = -0.4, width + 0.4, 0.4
    ridge, y, middle = height + 0.4 * depth, height, depth / 2
    shape.quad(material, [(a, y, depth + eave), (b, y, depth + eave), (b, ridge, middle), (a, ridge, middle)])
    shape.quad(material, [(b, y, -eave), (a, y, -eave), (a, ridge, middle), (b, ridge, middle)])


def house(materials, kind):
    width, height, depth, storeys = HOUSES[kind]
    shape = Shape()
    shape.box(materials[kind], (0, 0, 0), (width, height, depth), skip="-y")
    windows(shape, materials["frame"], (width, height, depth), storeys)
    roof(shape, materials["roof"], (width, height, depth))
    return shape


def tree(materials, height):
    shape = Shape()
    shape.lathe(materials["bark"], (0, 0, 0), [(0.18, 0.0), (0.14, 0.45 * height)], segments=7)
    crown = [(0.0, 0.35 * height), (0.24 * height, 0.45 * height), (0.3 * height, 0.62 * height),
             (0.2 * height, 0.85 * height), (0.0, height)]
    shape.lathe(materials["leaves"], (0, 0, 0), crown, segments=12, smooth=True)
    return shape


def post(materials):
    shape = Shape()
    shape.lathe(materials["metal"], (0, 0, 0), [(0.09, 0.0), (0.06, 4.0), (0.25, 4.2), (0.0, 4.6)], segments=8)
    return shape


def bench(materials):
    shape = Shape()
    for z in (0.0, 0.16, 0.32):
        shape.box(materials["wood"], (0, 0.42, z), (1.6, 0.46, z + 0.12))
    for x in (0.1, 1.4):
        shape.box(materials["metal"], (x, 0.0, 0.05), (x + 0.08, 0.40, 0.4))
    return shape


def ground(materials):
    """Grass with a street along two of its sides."""
    shape = Shape()
    across = [0.0, 6.0, BLOCK]
    shape.grid(materials["street"], (0, 0, 0), (0, 0, 1), (1, 0, 0), across, across, holes={(1, 1)})
    shape.grid(materials["grass"], (0, 0, 0), (0, 0, 1), (1, 0, 0), [6.0, BLOCK], [6.0, BLOCK])
    return shape


def town(blocks):
    gltf = Gltf()
    colours = {0: (0.62, 0.55, 0.45), 1: (0.7, 0.66, 0.6), 2: (0.55, 0.28, 0.2), "frame": 0.75,
               "roof": (0.35, 0.15, 0.1), "bark": (0.2, 0.13, 0.08), "leaves": (0.1, 0.25, 0.06),
               "metal": 0.2, "wood": (0.35, 0.22, 0.12), "street": 0.15, "grass": (0.12, 0.2, 0.07)}
    materials = {name: gltf.material(f"{name}", albedo) for name, albedo in colours.items()}
    houses = [gltf.mesh(f"house {kind}", house(materials, kind)) for kind in range(len(HOUSES))]
    trees = [gltf.mesh(f"tree {height} m", tree(materials, height)) for height in (5, 7, 9)]
    lamp, seat = gltf.mesh("lamp post", post(materials)), gltf.mesh("bench", bench(materials))
    plot = gltf.mesh("plot", ground(materials))
    chance = random.Random(11)
    for row in range(blocks):
        for column in range(blocks):
            block(gltf, chance, (column * BLOCK, row * BLOCK), houses, trees, lamp, seat, plot)
    side = blocks * BLOCK
    gltf.camera("from above", (-0.15 * side, 0.35 * side, -0.15 * side), (0.4 * side, 0.0, 0.4 * side),
                math.radians(40), 16 / 9)
    return gltf


def block(gltf, chance, corner, houses, trees, lamp, seat, plot):
    x, z = corner
    at = lambda u, v: (x + u, 0.0, z + v)
    gltf.node("plot", plot, at(0, 0))
    for u, v in ((9, 9), (25, 9), (9, 25), (25, 25)):
        gltf.node("house", chance.choice(houses), at(u + chance.uniform(0, 1.5), v + chance.uniform(0, 1)))
    for k in range(12):
        gltf.node("tree", chance.choice(trees), at(7.2, 8 + 2.7 * k) if k < 6 else at(8 + 2.7 * k, 7.2),
                  turn=chance.uniform(0, 6.2))
    for k in range(6):
        gltf.node("lamp post", lamp, at(6.4, 7 + 12 * k) if k < 3 else at(7 + 12 * (k - 2), 6.4))
    for v in (23.2, 24.4):
        gltf.node("bench", seat, at(22.4, v))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("target")
    parser.add_argument("--blocks", type=int, default=20, metavar="N", help="blocks along a side (20)")
    options = parser.parse_args()
    town(options.blocks).write(options.target)


if __name__ == "__main__":
    main()
