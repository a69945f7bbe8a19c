#!/usr/bin/env python3
"""Adds a lamp that shines down and a box the size of a chair to a .glb file.

    furnish.py IN.glb OUT.glb --lamp X,Y,Z,WIDTH,DEPTH,LUMINANCE --chair X,Y,Z

Lengths in metres, luminance in cd/m²; the chair's place is its centre. Standard library only.
"""

import argparse
import json
import struct

CHAIR = (0.5, 0.9, 0.5)  # width, height, depth [m]
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
FLOAT, UNSIGNED_SHORT = 5126, 5123
JSON_CHUNK, BINARY_CHUNK, MAGIC = 0x4E4F534A, 0x004E4942, 0x46546C67


class Glb:
    def __init__(self, path):
        data = open(path, "rb").read()
        (length,) = struct.unpack_from("<I", data, 12)
        self.json = json.loads(data[20 : 20 + length])
        (size,) = struct.unpack_from("<I", data, 20 + length)
        self.binary = bytearray(data[28 + length : 28 + length + size])

    def append(self, key, value):
        self.json.setdefault(key, []).append(value)
        return len(self.json[key]) - 1

    def accessor(self, data, target, **rest):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        self.binary += data
        return self.append(
            "accessors", {"bufferView": self.append("bufferViews", {**view, "target": target}), **rest}
        )

    def add(self, name, points, quads, material, place=(0, 0, 0)):
        positions = self.accessor(
            b"".join(struct.pack("<3f", *p) for p in points), ARRAY_BUFFER,
            componentType=FLOAT, count=len(points), type="VEC3",
            min=[min(p[k] for p in points) for k in range(3)],
            max=[max(p[k] for p in points) for k in range(3)])
        corners = [i for a, b, c, d in quads for i in (a, b, c, a, c, d)]
        indices = self.accessor(
            struct.pack(f"<{len(corners)}H", *corners), ELEMENT_ARRAY_BUFFER,
            componentType=UNSIGNED_SHORT, count=len(corners), type="SCALAR")
        mesh = {"name": name, "primitives": [{"attributes": {"POSITION": positions},
                "indices": indices, "material": self.append("materials", material)}]}
        node = {"name": name, "mesh": self.append("meshes", mesh), "translation": place}
        scene = self.json["scenes"][self.json.get("scene", 0)]
        scene["nodes"].append(self.append("nodes", node))

    def write(self, path):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.json["buffers"][0]["byteLength"] = len(self.binary)
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<3I", MAGIC, 2, 28 + len(text) + len(self.binary)))
            file.write(struct.pack("<2I", len(text), JSON_CHUNK) + text)
            file.write(struct.pack("<2I", len(self.binary), BINARY_CHUNK) + self.binary)


def add_lamp(glb, x, y, z, width, depth, luminance):
    dx, dz = width / 2, depth / 2
    points = [(x - dx, y, z - dz), (x + dx, y, z - dz), (x + dx, y, z + dz), (x - dx, y, z + dz)]
    strength = "KHR_materials_emissive_strength"
    if strength not in glb.json.setdefault("extensionsUsed", []):
        glb.json["extensionsUsed"].append(strength)
    glb.add("lamp", points, [(0, 1, 2, 3)], {
        "name": "lamp", "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]},
        "emissiveFactor": [1, 1, 1], "extensions": {strength: {"emissiveStrength": luminance}}})


def add_chair(glb, place):
    points, quads = [], []
    for axis in range(3):
        for side in (-1, 1):
            turn = ((-1, -1), (1, -1), (1, 1), (-1, 1))[::side]
            for u, v in turn:
                unit = {axis: side, (axis + 1) % 3: u, (axis + 2) % 3: v}
                points.append(tuple(unit[k] * CHAIR[k] / 2 for k in range(3)))
            quads.append(tuple(range(len(points) - 4, len(points))))
    glb.add("chair", points, quads, {
        "name": "chair",
        "pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.3, 0.2, 1], "metallicFactor": 0}}, place)


def main():
    numbers = lambda text: [float(value) for value in text.split(",")]
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("source")
    parser.add_argument("target")
    parser.add_argument("--lamp", type=numbers)
    parser.add_argument("--chair", type=numbers)
    options = parser.parse_args()
    glb = Glb(options.source)
    if options.lamp:
        add_lamp(glb, *options.lamp)
    if options.chair:
        add_chair(glb, options.chair)
    glb.write(options.target)


if __name__ == "__main__":
    main()
