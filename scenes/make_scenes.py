#!/usr/bin/env python3
"""Writes the scenes of this folder: ./make_scenes.py. Its output is kept in version control."""

import math
import os
import random

from gltf_writer import Gltf, Shape
from office import office
from room import room


def walls(gltf, materials, size):
    """The six walls of a room from (0, 0, 0) to `size`, each an object: its side to its material."""
    for side, material in materials.items():
        shape = Shape()
        skip = " ".join(set(materials) - {side})
        shape.box(material, (0, 0, 0), size, skip=skip, inward=True)
        gltf.object(f"wall {side}", shape)


def ceiling_lamp(gltf, material, xs, ceiling, zs):
    """A rectangle that faces down, 2 mm below the ceiling."""
    (x0, x1), y, (z0, z1) = xs, ceiling - 0.002, zs
    shape = Shape()
    shape.quad(material, [(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)])
    gltf.object("ceiling lamp", shape)


def cornell_box(glossy=False):
    """The Cornell box as measured (mm), here in metres, with the RGB albedos in common use.

    Glossy: a brushed metal block, a polished copper one, and a floor with a sheen."""
    gltf = Gltf()
    white = gltf.material("white", (0.725, 0.71, 0.68))
    green = gltf.material("green", (0.14, 0.45, 0.091))
    red = gltf.material("red", (0.63, 0.065, 0.05))
    lamp = gltf.material("light", 0.78, luminance=(17.0, 12.0, 4.0))
    ground = tall = short = white
    if glossy:
        ground = gltf.material("sheen", (0.725, 0.71, 0.68), metallic=0.4, roughness=0.45)
        tall = gltf.material("brushed metal", (0.85, 0.85, 0.83), metallic=1.0, roughness=0.35)
        short = gltf.material("copper", (0.9, 0.6, 0.45), metallic=0.9, roughness=0.2)

    def metres(corners):
        return [[c / 1000 for c in corner] for corner in corners]

    def wall(name, material, *corners):
        shape = Shape()
        shape.quad(material, metres(corners))
        gltf.object(name, shape)

    h = 548.8
    wall("floor", ground, (552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))
    wall("ceiling", white, (556, h, 0), (556, h, 559.2), (0, h, 559.2), (0, h, 0))
    wall("back wall", white, (549.6, 0, 559.2), (0, 0, 559.2), (0, h, 559.2), (556, h, 559.2))
    wall("right wall", green, (0, 0, 559.2), (0, 0, 0), (0, h, 0), (0, h, 559.2))
    wall("left wall", red, (552.8, 0, 0), (549.6, 0, 559.2), (556, h, 559.2), (556, h, 0))
    # Measured coplanar with the ceiling; half a millimetre keeps the two apart.
    y = h - 0.5
    wall("light", lamp, (343, y, 227), (343, y, 332), (213, y, 332), (213, y, 227))

    def block(name, material, height, outline):
        shape = Shape()
        shape.quad(material, metres([(x, height, z) for x, z in outline]))
        for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
            side = [(x0, 0, z0), (x1, 0, z1), (x1, height, z1), (x0, height, z0)]
            shape.quad(material, metres(side))
        gltf.object(name, shape)

    block("short block", short, 165, [(130, 65), (82, 225), (240, 272), (290, 114)])
    block("tall block", tall, 330, [(423, 247), (265, 296), (314, 456), (472, 406)])
    eye = [0.278, 0.273, -0.8]
    vertical_fov = 2 * math.atan(0.0125 / 0.035)  # film 25 mm, focal length 35 mm
    gltf.camera("camera", eye, [eye[0], eye[1], 0.0], vertical_fov, 1.0)
    return gltf


def glossy_floor():
    """A room with a polished floor, coloured blocks on it and a lamp in the ceiling."""
    gltf = Gltf()
    plaster = gltf.material("plaster", (0.7, 0.68, 0.65))
    blue = gltf.material("blue wall", (0.25, 0.35, 0.6))
    orange = gltf.material("orange", (0.75, 0.35, 0.1))
    green = gltf.material("green", (0.25, 0.5, 0.2))
    polished = gltf.material("polished floor", (0.6, 0.55, 0.5), metallic=0.7, roughness=0.3)
    lamp = gltf.material("lamp", 0.5, luminance=(60.0, 55.0, 48.0))
    width, height, depth = 4.0, 2.6, 3.0
    sides = {"-x": plaster, "+x": blue, "-y": polished, "+y": plaster, "-z": plaster, "+z": plaster}
    walls(gltf, sides, (width, height, depth))
    for name, material, low, high in (
        ("orange block", orange, (0.8, 0.0, 0.6), (1.4, 1.2, 1.2)),
        ("green block", green, (2.4, 0.0, 0.9), (3.2, 0.5, 1.7)),
    ):
        shape = Shape()
        shape.box(material, low, high, skip="-y")
        gltf.object(name, shape)
    ceiling_lamp(gltf, lamp, (1.5, 2.5), height, (1.0, 2.0))
    gltf.camera("camera", [2.6, 1.5, 2.9], [1.8, 0.5, 0.6], 1.0, 1.5)
    return gltf


def specular_objects():
    """Metal and glazed objects in a diffuse room, after figure 2 of the glossy paper."""
    gltf = Gltf()
    plaster = gltf.material("plaster", (0.75, 0.73, 0.7))
    red = gltf.material("red wall", (0.6, 0.12, 0.1))
    blue = gltf.material("blue wall", (0.12, 0.2, 0.55))
    lamp = gltf.material("lamp", 0.5, luminance=(40.0, 38.0, 34.0))
    gold = gltf.material("gold", (1.0, 0.77, 0.34), metallic=1.0, roughness=0.25)
    steel = gltf.material("steel", (0.8, 0.8, 0.8), metallic=1.0, roughness=0.4)
    glaze = gltf.material("glaze", (0.2, 0.45, 0.35), metallic=0.3, roughness=0.3)
    width, height, depth = 3.0, 2.4, 3.0
    sides = {"-x": red, "+x": blue, "-y": plaster, "+y": plaster, "-z": plaster, "+z": plaster}
    walls(gltf, sides, (width, height, depth))

    def ball(radius, rings=24):
        angles = [math.pi * k / rings for k in range(1, rings)]
        between = [(radius * math.sin(a), radius - radius * math.cos(a)) for a in angles]
        return [(0.0, 0.0), *between, (0.0, 2 * radius)]

    vase = [(0.0, 0.0), (0.16, 0.0), (0.26, 0.2), (0.28, 0.4), (0.2, 0.62), (0.11, 0.78), (0.15, 0.9),
            (0.0, 0.92)]
    cone = [(0.0, 0.0), (0.32, 0.0), (0.0, 0.9)]
    for name, material, centre, profile, smooth in (
        ("gold ball", gold, (0.9, 0.0, 1.1), ball(0.4), True),
        ("steel vase", steel, (1.7, 0.0, 0.8), vase, True),
        ("glazed cone", glaze, (2.2, 0.0, 1.5), cone, False),
    ):
        shape = Shape()
        shape.lathe(material, centre, profile, segments=48, smooth=smooth)
        gltf.object(name, shape)
    ceiling_lamp(gltf, lamp, (1.0, 2.0), height, (1.0, 2.0))
    gltf.camera("camera", [1.6, 1.1, 2.9], [1.55, 0.5, 0.9], 0.9, 1.4)
    return gltf


def two_rooms(window=False):
    """Two rooms in an L, joined by a door in a thick wall; only the first has a lamp, or instead
    of it a window in a wall as thick."""
    gltf = Gltf()
    plaster = gltf.material("plaster", (0.7, 0.68, 0.65))
    wood = gltf.material("floor", (0.45, 0.36, 0.28))
    blue = gltf.material("blue", (0.3, 0.4, 0.6))
    lamp = gltf.material("lamp", 0.5, luminance=(110.0, 100.0, 85.0))
    height, lintel, sill = 2.6, 2.1, 0.9
    door, opening = (2.6, 3.5), (0.8, 1.8)
    wall_near, wall_far = 3.0, 3.2
    x_axis, y_axis, z_axis = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    minus_x, minus_y = (-1, 0, 0), (0, -1, 0)

    ys = [0.0, *([sill] if window else ()), lintel, height]
    doorway = [(1, row) for row in range(len(ys) - 2)]

    def room_shell(prefix, colour, x0, x1, z0, z1, door_at_far_side):
        # Lines through the door's edges keep neighbouring surfaces free of T-junctions.
        xs = [0.0, door[0] - x0, door[1] - x0, x1 - x0]
        zs = [0.0, *(opening if window and door_at_far_side else ()), z1 - z0]
        floor, ceiling, back, front, left, right = (Shape() for _ in range(6))
        floor.grid(wood, (x0, 0, z0), z_axis, x_axis, zs, xs)
        ceiling.grid(plaster, (x0, height, z0), x_axis, z_axis, xs, zs)
        panes = [(1, 1)] if len(zs) > 2 else ()
        left.grid(plaster, (x0, 0, z0), y_axis, z_axis, ys, zs, panes)
        right.grid(colour, (x1, 0, z0), z_axis, y_axis, zs, ys)
        back.grid(plaster, (x0, 0, z0), x_axis, y_axis, xs, ys, () if door_at_far_side else doorway)
        mirrored = [x1 - x0 - x for x in reversed(xs)]
        holes = doorway if door_at_far_side else ()
        front.grid(plaster, (x1, 0, z1), minus_x, y_axis, mirrored, ys, holes)
        names = ("floor", "ceiling", "wall -z", "wall +z", "wall -x", "wall +x")
        for name, shape in zip(names, (floor, ceiling, back, front, left, right)):
            gltf.object(f"{prefix} {name}", shape)

    room_shell("lit room", plaster, 0.0, 4.0, 0.0, wall_near, True)
    room_shell("dark room", blue, 1.2, 4.0, wall_far, 6.2, False)

    frame = Shape()
    depth, width = [0.0, wall_far - wall_near], [0.0, door[1] - door[0]]
    frame.grid(wood, (door[0], 0, wall_near), z_axis, x_axis, depth, width)
    up, down = ys[:-1], [lintel - y for y in reversed(ys[:-1])]
    frame.grid(plaster, (door[0], 0, wall_near), y_axis, z_axis, up, depth)
    frame.grid(plaster, (door[1], lintel, wall_near), minus_y, z_axis, down, depth)
    frame.grid(plaster, (door[0], lintel, wall_near), x_axis, z_axis, width, depth)
    gltf.object("door frame", frame)

    if window:
        shape = Shape()
        shape.box(plaster, (wall_near - wall_far, sill, opening[0]), (0.0, lintel, opening[1]),
                  skip="-x +x", inward=True)
        gltf.object("window frame", shape)
    else:
        light = Shape()
        light.grid(lamp, (1.0, height - 0.002, 1.0), x_axis, z_axis, [0.0, 1.0], [0.0, 1.0])
        gltf.object("ceiling lamp", light)
    gltf.camera("camera", [1.5, 1.5, 5.9], [3.2, 1.1, 2.0], 1.1, 1.5)
    return gltf


def city(seed=4):
    """A city of 64 boxes without bottoms on a plane, for the sky to light: nothing shines."""
    lots, lot, border = 8, 10.0, 5.0  # boxes a side, metres
    numbers = random.Random(seed)
    gltf = Gltf()
    ground = gltf.material("ground", 0.4)
    end = lots * lot + border
    shape = Shape()
    shape.quad(ground, [(-border, 0, end), (end, 0, end), (end, 0, -border), (-border, 0, -border)])
    gltf.object("ground", shape)
    for k in range(lots * lots):
        colour = [numbers.uniform(0.15, 0.8) for _ in range(3)]
        width, depth = (numbers.uniform(4.0, 8.0) for _ in range(2))
        x = k % lots * lot + numbers.uniform(0.5, lot - 0.5 - width)
        z = k // lots * lot + numbers.uniform(0.5, lot - 0.5 - depth)
        height = 3.0 * math.exp(numbers.uniform(0.0, 2.0))
        shape = Shape()
        material = gltf.material(f"house {k}", colour)
        shape.box(material, (x, 0, z), (x + width, height, z + depth), skip="-y")
        gltf.object(f"house {k}", shape)
    gltf.camera("camera", [-25.0, 45.0, 100.0], [40.0, 0.0, 42.0], 0.8, 1.5)
    return gltf


def furnace(albedo):
    """A closed unit cube of one albedo and exitance 1 lm/m²: radiosity is 1/(1 - albedo)."""
    gltf = Gltf()
    wall = gltf.material("wall", albedo, luminance=[1 / math.pi] * 3)
    sides = ("+x", "+y", "+z", "-x", "-y", "-z")
    walls(gltf, {side: wall for side in sides}, (1, 1, 1))
    gltf.camera("camera", [0.1, 0.5, 0.9], [0.6, 0.45, 0.3], 1.2, 1.0)
    return gltf


def plates(perpendicular):
    """Two black unit plates, the first with exitance 1 lm/m²: form factors in closed form."""
    gltf = Gltf()
    emitter = gltf.material("emitter", 0.0, luminance=[1 / math.pi] * 3)
    black = gltf.material("receiver", 0.0)
    first, second = Shape(), Shape()
    first.quad(emitter, [(0, 0, 1), (1, 0, 1), (1, 0, 0), (0, 0, 0)])
    if perpendicular:
        second.quad(black, [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    else:
        second.quad(black, [(0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)])
    gltf.object("emitter", first)
    gltf.object("receiver", second)
    gltf.camera("camera", [2.2, 0.8, 2.2], [0.5, 0.4, 0.5], 0.8, 1.0)
    return gltf


def sealed_box():
    """A closed box with thick walls on a floor beside a bright panel: inside stays dark."""
    gltf = Gltf()
    grey = gltf.material("floor", 0.5)
    ochre = gltf.material("box", (0.7, 0.5, 0.3))
    white = gltf.material("inside", 0.8)
    lamp = gltf.material("lamp", 0.5, luminance=(1000.0, 1000.0, 1000.0))
    floor, outside, inside, panel = (Shape() for _ in range(4))
    floor.quad(grey, [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)])
    outside.box(ochre, (-0.5, 0.0, -0.5), (0.5, 1.0, 0.5))
    inside.box(white, (-0.4, 0.1, -0.4), (0.4, 0.9, 0.4), inward=True)
    panel.quad(lamp, [(-1.5, 0.2, -0.8), (-1.5, 1.8, -0.8), (-1.5, 1.8, 0.8), (-1.5, 0.2, 0.8)])
    for name, shape in (("floor", floor), ("box outside", outside), ("box inside", inside), ("lamp", panel)):
        gltf.object(name, shape)
    gltf.camera("camera", [-1.0, 1.5, 2.7], [-0.3, 0.4, 0.0], 0.8, 1.5)
    return gltf


def moving_box(lamp_side, turning=False):
    """A Cornell box of the dynamic radiosity thesis, section 5.1: a large box in the middle that
    may turn, and a lamp in the ceiling that sends the same light whatever its size. Turning: it
    does, once in two seconds."""
    gltf = Gltf()
    white = gltf.material("white", 0.7)
    red = gltf.material("red", (0.63, 0.06, 0.05))
    green = gltf.material("green", (0.14, 0.45, 0.09))
    power = 16.0  # lm/sr
    lamp = gltf.material("lamp", 0.7, luminance=[power / lamp_side**2] * 3)
    walls(gltf, {"-x": red, "+x": green, "-y": white, "+y": white, "-z": white, "+z": white}, (2, 2, 2))
    light, box = Shape(), Shape()
    low, high = 1 - lamp_side / 2, 1 + lamp_side / 2
    light.quad(lamp, [(low, 1.995, low), (high, 1.995, low), (high, 1.995, high), (low, 1.995, high)])
    axis = 1.0 if turning else 0.0  # where the box has its own origin
    near, far = 0.65 - axis, 1.35 - axis
    box.box(white, (near, 0.3, near), (far, 1.0, far))
    gltf.object("lamp", light)
    gltf.node("box", gltf.mesh("box", box), (axis, 0.0, axis) if turning else None)
    if turning:
        gltf.turn("box", seconds=2.0)
        gltf.camera("camera", [0.2, 1.35, 1.9], [1.1, 0.35, 0.75], 1.25, 1.0)  # sees the shadow
    else:
        gltf.camera("camera", [1.0, 1.0, 1.95], [1.0, 0.9, 0.0], 1.3, 1.0)
    return gltf


def moving_indirect():
    """The indirect scene of the dynamic radiosity thesis, section 5.1: white walls of albedo 0.9,
    daylight that comes in behind a partition at the right, a box that turns at the left."""
    gltf = Gltf()
    white = gltf.material("white", 0.9)
    sky = gltf.material("daylight", 0.0, luminance=(20.0, 20.0, 20.0))
    walls(gltf, {side: white for side in ("-x", "+x", "-y", "+y", "-z", "+z")}, (4, 2, 2))
    window, partition, box = Shape(), Shape(), Shape()
    window.quad(sky, [(3.99, 1.6, 1.6), (3.99, 1.6, 0.4), (3.99, 0.4, 0.4), (3.99, 0.4, 1.6)])
    partition.box(white, (2.9, 0.0, 0.5), (3.0, 2.0, 2.0))
    box.box(white, (0.75, 0.3, 0.75), (1.25, 0.8, 1.25))
    gltf.object("window", window)
    gltf.object("partition", partition)
    gltf.object("box", box)
    gltf.camera("camera", [2.7, 1.2, 1.9], [0.6, 0.6, 0.4], 1.1, 1.5)
    return gltf


def planes():
    """Five red and two white two-sided planes, after figure 8 of the stochastic depth buffering
    paper: the lower white one keeps red light from the one on top."""
    gltf = Gltf()
    red = gltf.material("red", (0.8, 0.05, 0.05), double_sided=True)
    white = gltf.material("white", 0.8, double_sided=True)
    side, gap = 1.0, 0.2
    stack = [(f"red {k + 1}", red) for k in range(5)] + [("lower white", white), ("top", white)]
    for k, (name, material) in enumerate(stack):
        y = k * gap
        shape = Shape()
        shape.quad(material, [(0, y, side), (side, y, side), (side, y, 0), (0, y, 0)])
        gltf.object(name, shape)
    gltf.camera("camera", [1.9, 1.25, 2.7], [0.5, 0.6, 0.5], 0.75, 1.0)
    return gltf


def on_slab(objects, aspect):
    """A scene of shapes in their places on a thick square slab whose top is at height 0."""
    gltf = Gltf()
    stone = gltf.material("stone", (0.7, 0.68, 0.65))
    shape = Shape()
    shape.box(stone, (-2.0, -0.4, -2.0), (2.0, 0.0, 2.0))
    gltf.object("slab", shape)
    objects(gltf)
    gltf.camera("camera", [3.6, 2.9, 4.6], [0.0, 0.15, 0.0], 0.7, aspect)
    return gltf


def four_cubes():
    """48 triangles, after figure 9 (a) of the same paper."""

    def cubes(gltf):
        for name, albedo, (x, z), side, turn in (
            ("orange cube", (0.75, 0.35, 0.1), (-0.8, -0.5), 1.2, 0.3),
            ("blue cube", (0.15, 0.3, 0.7), (0.9, -0.6), 0.9, 0.9),
            ("white cube", (0.75, 0.75, 0.75), (0.3, 0.9), 0.6, 0.5),
        ):
            shape = Shape()
            h = side / 2
            shape.box(gltf.material(name, albedo), (-h, 0.0, -h), (h, side, h))
            gltf.node(name, gltf.mesh(name, shape), (x, 0.0, z), turn)

    return on_slab(cubes, 1.5)


def three_balls():
    """3276 triangles, after figure 9 (b) of the same paper."""

    def balls(gltf):
        radius, rings = 0.7, 18
        angles = [math.pi * k / rings for k in range(1, rings)]
        between = [(radius * math.sin(a), radius - radius * math.cos(a)) for a in angles]
        shape = Shape()
        yellow = gltf.material("yellow", (0.8, 0.6, 0.15))
        profile = [(0.0, 0.0), *between, (0.0, 2 * radius)]
        shape.lathe(yellow, (0, 0, 0), profile, segments=32, smooth=True)
        ball = gltf.mesh("ball", shape)
        for k, (x, z) in enumerate([(-0.9, -0.5), (0.85, -0.7), (0.1, 0.85)]):
            gltf.node(f"ball {k + 1}", ball, (x, 0.0, z))

    return on_slab(balls, 1.5)


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    scenes = {
        "cornell-box": cornell_box(),
        "glossy-cornell-box": cornell_box(glossy=True),
        "glossy-floor": glossy_floor(),
        "specular-objects": specular_objects(),
        "two-rooms": two_rooms(),
        "two-rooms-window": two_rooms(window=True),
        "furnace-0.5": furnace(0.5),
        "furnace-0.9": furnace(0.9),
        "plates-parallel": plates(perpendicular=False),
        "plates-perpendicular": plates(perpendicular=True),
        "sealed-box": sealed_box(),
        "moving-large-lamp": moving_box(0.8),
        "moving-small-lamp": moving_box(0.2),
        "turning-box": moving_box(0.8, turning=True),
        "moving-indirect": moving_indirect(),
        "city": city(),
        "room": room(),
        "office": office(),
        "planes": planes(),
        "four-cubes": four_cubes(),
        "three-balls": three_balls(),
    }
    for name, gltf in scenes.items():
        gltf.write(os.path.join(folder, f"{name}.gltf"))


if __name__ == "__main__":
    main()
