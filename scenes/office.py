"""An office with six desks and a meeting room beside it, 11.1 × 5 × 2.8 m, and sixteen lamps, each with its own name."""

import math

from gltf_writer import Gltf, Shape

HEIGHT, DEPTH = 2.8, 5.0
OFFICE, MEETING = (0.0, 7.0), (7.1, 11.1)  # from, to along x [m]
DOOR = (3.4, 4.4, 2.1)  # from, to along z, height [m]
WINDOW = (0.8, 4.2, 0.9, 2.3)  # from, to along z, and up [m]
DESK_TOP = 0.74
DESKS = [(x, z) for z in (1.2, 3.6) for x in (1.5, 3.5, 5.5)]  # centres
TABLE = (9.1, 1.9)
DOWN = (0.0, -1.0, 0.0)
WARM, NEUTRAL, WHITE = (1.0, 0.75, 0.5), (1.0, 0.9, 0.78), (1.0, 0.97, 0.94)


def room(gltf, colours, name, span, floor):
    """Floor, ceiling and the two long walls."""
    (a, b), h, d = span, HEIGHT, DEPTH
    ground, ceiling, back, front = (Shape() for _ in range(4))
    ground.quad(floor, [(a, 0, d), (b, 0, d), (b, 0, 0), (a, 0, 0)])
    ceiling.quad(colours["white"], [(a, h, 0), (b, h, 0), (b, h, d), (a, h, d)])
    back.quad(colours["white"], [(a, 0, 0), (b, 0, 0), (b, h, 0), (a, h, 0)])
    front.quad(colours["white"], [(b, 0, d), (a, 0, d), (a, h, d), (b, h, d)])
    for part, shape in (("floor", ground), ("ceiling", ceiling), ("back wall", back), ("front wall", front)):
        gltf.object(f"{name} {part}", shape)


def cross_walls(gltf, colours):
    """The wall with the window, the two sides of the wall with the door, and the far wall of the meeting room."""
    h, d = HEIGHT, DEPTH
    from_z, to_z, low, high = WINDOW
    window, door, far = Shape(), Shape(), Shape()
    window.grid(colours["white"], (0, 0, 0), (0, 1, 0), (0, 0, 1), [0.0, low, high, h], [0.0, from_z, to_z, d],
                holes=[(1, 1)])
    window.box(colours["white"], (-0.2, low, from_z), (0, high, to_z), skip="-x +x", inward=True)
    zs, ys = [0.0, DOOR[0], DOOR[1], d], [0.0, DOOR[2], h]
    door.grid(colours["white"], (OFFICE[1], 0, 0), (0, 0, 1), (0, 1, 0), zs, ys, holes=[(1, 0)])
    door.grid(colours["green"], (MEETING[0], 0, 0), (0, 1, 0), (0, 0, 1), ys, zs, holes=[(0, 1)])
    door.box(colours["oak"], (OFFICE[1], 0, DOOR[0]), (MEETING[0], DOOR[2], DOOR[1]), skip="-x +x", inward=True)
    far.quad(colours["green"], [(MEETING[1], 0, 0), (MEETING[1], 0, d), (MEETING[1], h, d), (MEETING[1], h, 0)])
    for name, shape in (("window wall", window), ("door wall", door), ("far wall", far)):
        gltf.object(name, shape)


def desk(colours):
    """A desk with a screen and the stand of its lamp."""
    shape = Shape()
    shape.box(colours["oak"], (-0.8, DESK_TOP - 0.03, -0.4), (0.8, DESK_TOP, 0.4))
    for x in (-0.78, 0.73):
        shape.box(colours["metal"], (x, 0, -0.35), (x + 0.05, DESK_TOP - 0.03, 0.35), skip="-y +y")
    shape.box(colours["black"], (-0.3, DESK_TOP + 0.1, -0.3), (0.3, DESK_TOP + 0.45, -0.27))
    shape.box(colours["black"], (-0.03, DESK_TOP, -0.3), (0.03, DESK_TOP + 0.1, -0.27), skip="-y +y")
    shape.box(colours["metal"], (0.56, DESK_TOP, -0.22), (0.58, DESK_TOP + 0.5, -0.2), skip="-y")
    shape.box(colours["metal"], (0.48, DESK_TOP + 0.5, -0.24), (0.66, DESK_TOP + 0.53, 0.02))
    return shape


def chair(colours):
    shape = Shape()
    shape.box(colours["blue"], (-0.22, 0.42, -0.22), (0.22, 0.48, 0.22))
    shape.box(colours["blue"], (-0.22, 0.48, 0.18), (0.22, 0.9, 0.22), skip="-y")
    shape.box(colours["metal"], (-0.03, 0, -0.03), (0.03, 0.42, 0.03), skip="-y +y")
    return shape


def furniture(gltf, colours):
    work_place, seat = gltf.mesh("desk", desk(colours)), gltf.mesh("chair", chair(colours))
    for k, (x, z) in enumerate(DESKS):
        gltf.node(f"desk {k + 1}", work_place, (x, 0, z))
        gltf.node(f"chair {k + 1}", seat, (x, 0, z + 0.6), turn=0.3 * (k - 2.5))
    table, (x, z) = Shape(), TABLE
    table.box(colours["oak"], (-1.1, DESK_TOP - 0.04, -0.5), (1.1, DESK_TOP, 0.5))
    table.box(colours["metal"], (-0.9, 0, -0.1), (0.9, DESK_TOP - 0.04, 0.1), skip="-y +y")
    gltf.node("table", gltf.mesh("table", table), (x, 0, z))
    for k, (along, side) in enumerate(((-0.6, -1), (0.6, -1), (-0.6, 1), (0.6, 1))):
        gltf.node(f"guest chair {k + 1}", seat, (x + along, 0, z + 0.75 * side), turn=math.pi if side < 0 else 0.0)


def panels(gltf):
    """Six ceiling panels of 60 cm a side, each of its own material: about 3,400 lm each."""
    side, y = 0.6, HEIGHT - 0.005
    for k, (x, z) in enumerate(DESKS):
        name = f"panel {k + 1}"
        material = gltf.material(name, 0.8, luminance=[3000.0 * c for c in WHITE])
        a, b, c, d = x - side / 2, x + side / 2, z + 0.1, z + 0.1 + side
        shape = Shape()
        shape.quad(material, [(a, y, c), (b, y, c), (b, y, d), (a, y, d)])
        gltf.object(name, shape)


def desk_lamps(gltf):
    for k, (x, z) in enumerate(DESKS):
        gltf.light(f"desk lamp {k + 1}", "spot", (x + 0.57, DESK_TOP + 0.49, z - 0.05), 150.0, WARM, DOWN,
                   inner=0.6, outer=1.1)


def meeting_lamps(gltf, colours):
    """Two lamps that hang over the table, and two spots that light the far wall."""
    shade = Shape()
    shade.lathe(colours["black"], (0, 0, 0), [(0, 0.04), (0.16, 0.04), (0.14, 0.08), (0, 0.08)])
    shade.box(colours["black"], (-0.01, 0.08, -0.01), (0.01, HEIGHT - 1.6, 0.01), skip="-y +y")
    mesh = gltf.mesh("shade", shade)
    for k, side in enumerate((-1, 1)):
        x, y, z = TABLE[0] + 0.55 * side, 1.6, TABLE[1]
        gltf.node(f"shade {k + 1}", mesh, (x, y, z))
        gltf.light(f"pendant {k + 1}", "point", (x, y - 0.03, z), 120.0, NEUTRAL)
        gltf.light(f"wall spot {k + 1}", "spot", (MEETING[1] - 0.8, HEIGHT - 0.1, 2.5 + 1.4 * side), 600.0, WARM,
                   (0.6, -0.8, 0.0), inner=0.3, outer=0.55)


def office():
    gltf = Gltf()
    albedos = {"white": (0.80, 0.79, 0.76), "green": (0.35, 0.46, 0.36), "oak": (0.50, 0.34, 0.19),
               "carpet": (0.22, 0.24, 0.28), "parquet": (0.42, 0.27, 0.15), "metal": 0.45, "black": 0.04,
               "blue": (0.08, 0.17, 0.33)}
    colours = {name: gltf.material(name, albedo) for name, albedo in albedos.items()}
    room(gltf, colours, "office", OFFICE, colours["carpet"])
    room(gltf, colours, "meeting room", MEETING, colours["parquet"])
    cross_walls(gltf, colours)
    furniture(gltf, colours)
    panels(gltf)
    desk_lamps(gltf)
    meeting_lamps(gltf, colours)
    gltf.camera("camera", [0.4, 1.9, 4.7], [6.4, 0.7, 1.6], 1.0, 16 / 9)
    return gltf
