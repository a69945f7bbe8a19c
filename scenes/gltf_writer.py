"""Writes small glTF 2.0 files with everything embedded. Standard library only."""

import base64
import json
import math
import struct
import zlib


def sub(a, b):
    return [a[k] - b[k] for k in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


def float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def png(width, height, pixel):
    """An RGB PNG as bytes; pixel(x, y) yields linear reflectances 0…1, top row first."""

    def code(c):
        c = min(max(c, 0.0), 1.0)
        s = 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055
        return int(s * 255 + 0.5)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(
        b"\0" + bytes(code(c) for x in range(width) for c in pixel(x, y)) for y in range(height)
    )
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows, 9))
        + chunk(b"IEND", b"")
    )


def turned_to(direction):
    """The shortest rotation of -z to `direction`, not +z, as a quaternion."""
    x, y, z = unit(direction)
    half = [y, -x, 0.0, 1.0 - z]
    length = math.sqrt(sum(value * value for value in half))
    return [value / length + 0.0 for value in half]


class Part:
    """Triangles of one material."""

    def __init__(self):
        self.positions, self.normals, self.texcoords, self.indices = [], [], [], []

    def add(self, positions, normals, triangles, texcoords=None):
        first = len(self.positions)
        self.positions += positions
        self.normals += normals
        self.texcoords += texcoords or []
        self.indices += [first + k for triangle in triangles for k in triangle]


class Shape:
    """A mesh in the making: one Part for each material. All angles in radians, lengths in metres."""

    def __init__(self):
        self.parts = {}

    def part(self, material):
        return self.parts.setdefault(material, Part())

    def quad(self, material, corners, texcoords=None):
        """Four corners, counter-clockwise as seen from the front; one normal for all of it."""
        normal = unit(cross(sub(corners[2], corners[0]), sub(corners[3], corners[1])))
        self.part(material).add(
            [list(c) for c in corners], [normal] * 4, [(0, 1, 2), (0, 2, 3)], texcoords
        )

    def grid(self, material, origin, u, v, us, vs, holes=()):
        """Cells of a plane origin + a u + b v between the lines us and vs; normal along u × v."""
        normal = unit(cross(u, v))
        points = [[origin[k] + a * u[k] + b * v[k] for k in range(3)] for b in vs for a in us]
        triangles = []
        for row in range(len(vs) - 1):
            for column in range(len(us) - 1):
                if (column, row) in holes:
                    continue
                a = row * len(us) + column
                b = a + len(us)
                triangles += [(a, a + 1, b + 1), (a, b + 1, b)]
        used = sorted({k for triangle in triangles for k in triangle})
        place = {k: n for n, k in enumerate(used)}
        self.part(material).add(
            [points[k] for k in used],
            [normal] * len(used),
            [tuple(place[k] for k in triangle) for triangle in triangles],
        )

    def box(self, material, low, high, skip="", inward=False, top=None):
        """An axis-aligned box. `skip` names faces left out, of "-x +x -y +y -z +z"; `top` is the
        material of +y if it differs; `inward` makes a room of it."""
        (a, b, c), (d, e, f) = low, high
        faces = {
            "-x": [(a, b, c), (a, b, f), (a, e, f), (a, e, c)],
            "+x": [(d, b, f), (d, b, c), (d, e, c), (d, e, f)],
            "-y": [(a, b, c), (d, b, c), (d, b, f), (a, b, f)],
            "+y": [(a, e, f), (d, e, f), (d, e, c), (a, e, c)],
            "-z": [(d, b, c), (a, b, c), (a, e, c), (d, e, c)],
            "+z": [(a, b, f), (d, b, f), (d, e, f), (a, e, f)],
        }
        for name, corners in faces.items():
            if name in skip.split():
                continue
            material_here = top if top is not None and name == "+y" else material
            self.quad(material_here, corners[::-1] if inward else corners)

    def lathe(self, material, centre, profile, segments=24, smooth=False):
        """Turns a profile [(radius, height)] about the vertical axis; going up, the front is
        outside. `smooth` shades along the profile too. A zero radius closes the shape."""
        slopes = []
        for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
            length = math.hypot(r1 - r0, y1 - y0)
            slopes.append(((y1 - y0) / length, (r0 - r1) / length))
        bands = [[k, k + 1] for k in range(len(slopes))]
        for k0, k1 in bands:
            ends = [slopes[k0], slopes[k0]]
            if smooth:
                ends = [self._mean(slopes, k) for k in (k0, k1)]
            self._band(material, centre, profile[k0], profile[k1], ends, segments)

    @staticmethod
    def _mean(slopes, k):
        near = slopes[max(k - 1, 0) : k + 1]
        x, y = sum(s[0] for s in near), sum(s[1] for s in near)
        length = math.hypot(x, y)
        return (x / length, y / length)

    def _band(self, material, centre, lower, upper, slopes, segments):
        positions, normals, triangles = [], [], []
        for k in range(segments + 1):
            angle = 2 * math.pi * (k % segments) / segments
            x, z = math.cos(angle), -math.sin(angle)
            for (r, y), (out, up) in ((lower, slopes[0]), (upper, slopes[1])):
                positions.append([centre[0] + r * x, centre[1] + y, centre[2] + r * z])
                normals.append(unit([out * x, up, out * z]))
        for k in range(segments):
            a = 2 * k
            if lower[0] > 0:
                triangles.append((a, a + 2, a + 1))
            if upper[0] > 0:
                triangles.append((a + 1, a + 2, a + 3))
        self.part(material).add(positions, normals, triangles)


class Gltf:
    def __init__(self):
        self.data = bytearray()
        self.root = {
            "asset": {"version": "2.0", "generator": "lumel scenes/make_scenes.py"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
        }

    def material(self, name, albedo, luminance=None, image=None, double_sided=False,
                 metallic=0.0, roughness=1.0):
        """Linear albedo (number or RGB), emitted luminance [cd/m²], PNG bytes that multiply albedo."""
        rgb = list(albedo) if isinstance(albedo, (tuple, list)) else [albedo] * 3
        surface = {"baseColorFactor": rgb + [1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
        material = {"name": name, "pbrMetallicRoughness": surface}
        if image is not None:
            surface["baseColorTexture"] = {"index": self._texture(name, image)}
        if luminance is not None:
            strength = max(1.0, *luminance)
            material["emissiveFactor"] = [c / strength for c in luminance]
            if strength > 1.0:
                extension = "KHR_materials_emissive_strength"
                material["extensions"] = {extension: {"emissiveStrength": strength}}
                self._use(extension)
        if double_sided:
            material["doubleSided"] = True
        self.root["materials"].append(material)
        return len(self.root["materials"]) - 1

    def mesh(self, name, shape):
        primitives = []
        for material, part in shape.parts.items():
            check(name, part)
            attributes = {
                "POSITION": self._floats(part.positions, "VEC3", bounds=True),
                "NORMAL": self._floats(part.normals, "VEC3"),
            }
            if part.texcoords:
                attributes["TEXCOORD_0"] = self._floats(part.texcoords, "VEC2")
            indices = struct.pack(f"<{len(part.indices)}H", *part.indices)
            primitives.append(
                {
                    "attributes": attributes,
                    "indices": self._accessor(indices, 34963, 5123, "SCALAR", len(part.indices)),
                    "material": material,
                }
            )
        self.root["meshes"].append({"name": name, "primitives": primitives})
        return len(self.root["meshes"]) - 1

    def node(self, name, mesh, translation=None, turn=0.0):
        """Places a mesh; `turn` [rad] about the vertical axis."""
        node = {"name": name, "mesh": mesh}
        if translation is not None:
            node["translation"] = list(translation)
        if turn:
            node["rotation"] = [0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2)]
        self._add(node)

    def object(self, name, shape):
        self.node(name, self.mesh(name, shape))

    def camera(self, name, eye, target, vertical_fov, aspect):
        """A perspective camera with +y up; glTF cameras look along their -z axis."""
        back = unit(sub(eye, target))
        right = unit(cross([0.0, 1.0, 0.0], back))
        up = cross(back, right)
        perspective = {"yfov": vertical_fov, "aspectRatio": aspect, "znear": 0.01, "zfar": 100.0}
        camera = {"name": name, "type": "perspective", "perspective": perspective}
        self.root.setdefault("cameras", []).append(camera)
        matrix = right + [0.0] + up + [0.0] + back + [0.0] + list(eye) + [1.0]
        matrix = [x + 0.0 for x in matrix]
        self._add({"name": name, "camera": len(self.root["cameras"]) - 1, "matrix": matrix})

    def light(self, name, kind, position, intensity, colour, direction=(0.0, 0.0, -1.0), inner=0.0, outer=math.pi / 4):
        """A "point" or "spot" light of `intensity` [cd]; a spot shines along `direction`, its cone between the angles
        `inner` and `outer` from it."""
        extension = "KHR_lights_punctual"
        self._use(extension)
        light = {"name": name, "type": kind, "color": list(colour), "intensity": intensity}
        if kind == "spot":
            light["spot"] = {"innerConeAngle": inner, "outerConeAngle": outer}
        lights = self.root.setdefault("extensions", {}).setdefault(extension, {"lights": []})["lights"]
        lights.append(light)
        node = {"name": name, "translation": list(position), "extensions": {extension: {"light": len(lights) - 1}}}
        rotation = turned_to(direction)
        if rotation != [0.0, 0.0, 0.0, 1.0]:
            node["rotation"] = rotation
        self._add(node)

    def turn(self, name, seconds, steps=8):
        """Animates the node of that name: a whole turn about its own vertical axis."""
        index = next(k for k, node in enumerate(self.root["nodes"]) if node["name"] == name)
        times = [seconds * k / steps for k in range(steps + 1)]
        halves = [math.pi * k / steps for k in range(steps + 1)]
        turns = [[0.0, math.sin(h), 0.0, math.cos(h)] for h in halves]
        sampler = {
            "input": self._floats([[t] for t in times], "SCALAR", bounds=True, target=None),
            "output": self._floats(turns, "VEC4", target=None),
            "interpolation": "LINEAR",
        }
        channel = {"sampler": 0, "target": {"node": index, "path": "rotation"}}
        animation = {"name": f"{name} turns", "samplers": [sampler], "channels": [channel]}
        self.root.setdefault("animations", []).append(animation)

    def write(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.root["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            json.dump(self.root, file, indent=1)
            file.write("\n")

    def _use(self, extension):
        used = self.root.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def _add(self, node):
        self.root["nodes"].append(node)
        self.root["scenes"][0]["nodes"].append(len(self.root["nodes"]) - 1)

    def _texture(self, name, image):
        uri = "data:image/png;base64," + base64.b64encode(image).decode()
        self.root.setdefault("images", []).append({"name": name, "uri": uri})
        self.root.setdefault("samplers", [{"magFilter": 9729, "minFilter": 9987}])
        textures = self.root.setdefault("textures", [])
        textures.append({"source": len(self.root["images"]) - 1, "sampler": 0})
        return len(textures) - 1

    def _floats(self, rows, kind, bounds=False, target=34962):
        flat = [x for row in rows for x in row]
        index = self._accessor(struct.pack(f"<{len(flat)}f", *flat), target, 5126, kind, len(rows))
        if bounds:
            columns = list(zip(*rows))
            self.root["accessors"][index]["min"] = [float32(min(c)) for c in columns]
            self.root["accessors"][index]["max"] = [float32(max(c)) for c in columns]
        return index

    def _accessor(self, data, target, component, kind, count):
        self.data += b"\0" * (-len(self.data) % 4)
        view = {
            "buffer": 0,
            "byteOffset": len(self.data),
            "byteLength": len(data),
        }
        if target is not None:
            view["target"] = target
        self.data += data
        self.root["bufferViews"].append(view)
        self.root["accessors"].append(
            {
                "bufferView": len(self.root["bufferViews"]) - 1,
                "componentType": component,
                "count": count,
                "type": kind,
            }
        )
        return len(self.root["accessors"]) - 1


def check(name, part):
    """What must hold of every mesh: indices in range, unit normals that agree with the winding."""
    assert max(part.indices) < len(part.positions) <= 65535, name
    assert not part.texcoords or len(part.texcoords) == len(part.positions), name
    for n in part.normals:
        assert abs(dot(n, n) - 1) < 1e-9, name
    for k in range(0, len(part.indices), 3):
        corners = part.indices[k : k + 3]
        a, b, c = (part.positions[i] for i in corners)
        face = cross(sub(b, a), sub(c, a))
        assert dot(face, face) > 0, f"{name}: a triangle without area"
        for i in corners:
            assert dot(unit(face), part.normals[i]) > 0.5, f"{name}: a normal against the winding"
