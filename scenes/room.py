"""A small furnished room, 3 × 4 × 2.6 m, lit by a window and a lamp."""

import math

from gltf_writer import Gltf, Shape, cross, png, sub, unit

WIDTH, HEIGHT, DEPTH = 3.0, 2.6, 4.0


def hash01(*values):
    """A repeatable pseudo-random number 0…1."""
    n = 0x9E3779B9
    for value in values:
        n = ((n ^ (int(value) & 0xFFFFFFFF)) * 0x85EBCA6B) & 0xFFFFFFFF
        n ^= n >> 13
    n = (n * 0xC2B2AE35) & 0xFFFFFFFF
    return ((n ^ (n >> 16)) & 0xFFFF) / 65535.0


def mix(a, b, t):
    return [x + (y - x) * t for x, y in zip(a, b)]


def planks(x, y, size=256, plank=32):
    """Oak boards along v, each with its own tone and grain."""
    row = x // plank
    board_length = size // 2
    along = (y + int(hash01(row, 1) * board_length)) % size
    board = (row, along // board_length)
    tone = hash01(*board, 2)
    color = mix([0.36, 0.215, 0.115], [0.47, 0.30, 0.17], tone)
    grain = math.sin((x % plank) * 0.9 + 3 * math.sin(y * 2 * math.pi / size + 6 * tone) + 9 * tone)
    speck = hash01(x, y // 6, 3) - 0.5
    shade = 1.0 + 0.06 * grain + 0.07 * speck
    if x % plank == 0 or along % board_length == 0:
        shade *= 0.45
    return [c * shade for c in color]


def woven(x, y, width=144, height=96):
    """A rug: cream with a terracotta border and a lattice of lozenges."""
    cream, clay, blue = [0.72, 0.64, 0.52], [0.50, 0.15, 0.08], [0.07, 0.16, 0.27]
    edge = min(x, y, width - 1 - x, height - 1 - y)
    weave = 1.0 + 0.06 * ((x + y) % 2) - 0.03
    if edge < 3 or 9 <= edge < 11:
        color = blue
    elif edge < 9:
        color = clay
    else:
        u, v = (x - width // 2) % 24 - 12, (y - height // 2) % 24 - 12
        ring = abs(u) + abs(v)
        color = clay if 9 <= ring < 12 else blue if ring < 4 else cream
    return [c * weave for c in color]


def landscape(x, y, width=96, height=120):
    """A picture: hills under an evening sun."""
    u, v = x / width, y / height
    color = mix([0.82, 0.55, 0.30], [0.88, 0.78, 0.56], min(1.0, v * 1.6))
    if math.hypot((u - 0.64) * width, (v - 0.36) * height) < 13:
        color = [0.82, 0.22, 0.07]
    hills = [
        (0.52, 0.06, 5.0, 0.3, [0.42, 0.47, 0.46]),
        (0.64, 0.07, 4.0, 2.0, [0.20, 0.33, 0.34]),
        (0.78, 0.06, 6.0, 4.1, [0.09, 0.20, 0.21]),
    ]
    for base, swing, rate, phase, tone in hills:
        if v > base + swing * math.sin(rate * u + phase):
            color = tone
    return color


def shell(gltf, colours):
    floor, ceiling, back, front, right, left = (Shape() for _ in range(6))
    w, h, d = WIDTH, HEIGHT, DEPTH
    tile = 1.6  # metres of floor that one copy of the texture covers
    corners = [(0, 0, d), (w, 0, d), (w, 0, 0), (0, 0, 0)]
    floor.quad(colours["oak"], corners, [[x / tile, z / tile] for x, _, z in corners])
    white, sage = colours["white"], colours["sage"]
    ceiling.quad(white, [(0, h, 0), (w, h, 0), (w, h, d), (0, h, d)])
    back.quad(sage, [(0, 0, 0), (w, 0, 0), (w, h, 0), (0, h, 0)])
    front.quad(white, [(w, 0, d), (0, 0, d), (0, h, d), (w, h, d)])
    right.quad(white, [(w, 0, 0), (w, 0, d), (w, h, d), (w, h, 0)])
    zs, ys = [0.0, 1.0, 2.6, d], [0.0, 0.9, 2.25, h]
    left.grid(white, (0, 0, 0), (0, 1, 0), (0, 0, 1), ys, zs, holes=[(1, 1)])
    for name, shape in (
        ("floor", floor),
        ("ceiling", ceiling),
        ("back wall", back),
        ("front wall", front),
        ("right wall", right),
        ("window wall", left),
    ):
        gltf.object(name, shape)

    board = Shape()
    thick, tall = 0.018, 0.09
    board.box(white, (0, 0, 0), (w, tall, thick), skip="-x +x -y -z")
    board.box(white, (w - thick, 0, thick), (w, tall, d), skip="+x -y -z +z")
    board.box(white, (0, 0, thick), (thick, tall, d), skip="-x -y -z +z")
    gltf.object("skirting", board)


def window(gltf, colours):
    y0, y1, z0, z1, depth = 0.9, 2.25, 1.0, 2.6, 0.2
    white = colours["white"]
    reveal, sky, bars, sill = (Shape() for _ in range(4))
    reveal.box(white, (-depth, y0, z0), (0, y1, z1), skip="-x +x", inward=True)
    gltf.object("window reveal", reveal)
    sky.quad(colours["sky"], [(-depth, y0, z1), (-depth, y0, z0), (-depth, y1, z0), (-depth, y1, z1)])
    gltf.object("window", sky)
    bar, middle, cross_bar = 0.05, (z0 + z1) / 2, y0 + 0.9
    x0, x1 = -depth + 0.03, -depth + 0.08
    bars.box(white, (x0, y0, middle - bar / 2), (x1, y1, middle + bar / 2), skip="-y +y")
    for a, b in ((z0, middle - bar / 2), (middle + bar / 2, z1)):
        bars.box(white, (x0, cross_bar - bar / 2, a), (x1, cross_bar + bar / 2, b), skip="-z +z")
    gltf.object("window bars", bars)
    sill.box(white, (0.0, y0 - 0.035, z0 - 0.06), (0.09, y0, z1 + 0.06), skip="-x")
    gltf.object("window sill", sill)


def table_and_chairs(gltf, colours):
    walnut, oak = colours["walnut"], colours["beech"]
    table = Shape()
    table.box(walnut, (-0.6, 0.70, -0.4), (0.6, 0.74, 0.4))
    table.box(walnut, (-0.52, 0.63, -0.32), (0.52, 0.70, 0.32), skip="+y")
    for x in (-0.54, 0.48):
        for z in (-0.34, 0.28):
            table.box(walnut, (x, 0, z), (x + 0.06, 0.70, z + 0.06), skip="-y +y")
    place = (1.18, 0.0, 1.72)
    gltf.node("table", gltf.mesh("table", table), place)

    chair = Shape()
    chair.box(colours["seat"], (-0.21, 0.43, -0.21), (0.21, 0.47, 0.21))
    for x in (-0.20, 0.165):
        chair.box(oak, (x, 0, 0.165), (x + 0.035, 0.43, 0.2), skip="-y +y")
        chair.box(oak, (x, 0, -0.245), (x + 0.035, 0.88, -0.21), skip="-y")
    for y in (0.60, 0.76):
        chair.box(oak, (-0.165, y, -0.24), (0.165, y + 0.09, -0.215), skip="-x +x")
    mesh = gltf.mesh("chair", chair)
    gltf.node("chair by the window", mesh, (1.05, 0.0, 1.02), turn=0.15)
    gltf.node("chair in front", mesh, (1.42, 0.0, 2.42), turn=math.pi - 0.35)

    top = 0.74
    bowl, vase, cup, books = (Shape() for _ in range(4))
    outside = [(0.055, 0), (0.11, 0.022), (0.15, 0.06), (0.165, 0.1)]
    inside = [(0.157, 0.1), (0.14, 0.062), (0.1, 0.03), (0, 0.018)]
    bowl.lathe(colours["ceramic"], (0, 0, 0), outside + inside, 28, smooth=True)
    for k, (x, z) in enumerate(((-0.05, 0.035), (0.055, 0.03), (0.0, -0.06))):
        ball = [(0.048 * math.sin(a * math.pi / 8), 0.078 - 0.048 * math.cos(a * math.pi / 8)) for a in range(9)]
        ball[0], ball[-1] = (0, ball[0][1]), (0, ball[-1][1])
        bowl.lathe(colours["orange" if k else "apple"], (x, 0, z), ball, 16, smooth=True)
    gltf.node("fruit bowl", gltf.mesh("fruit bowl", bowl), (place[0] + 0.02, top, place[2] - 0.04))
    profile = [(0.04, 0), (0.065, 0.05), (0.07, 0.1), (0.05, 0.17), (0.026, 0.22), (0.036, 0.26)]
    vase.lathe(colours["teal"], (0, 0, 0), profile, 24, smooth=True)
    vase.lathe(colours["teal"], (0, 0, 0), [(0.036, 0.26), (0.022, 0.22), (0, 0.2)], 24)
    gltf.node("vase", gltf.mesh("vase", vase), (place[0] - 0.38, top, place[2] - 0.22))
    cup.lathe(colours["ceramic"], (0, 0, 0), [(0.032, 0), (0.04, 0.09), (0.035, 0.09), (0.028, 0.012), (0, 0.012)], 20)
    gltf.node("cup", gltf.mesh("cup", cup), (place[0] + 0.36, top, place[2] + 0.16))
    books.box(colours["book 1"], (-0.11, 0, -0.08), (0.11, 0.028, 0.08), skip="-y")
    books.box(colours["book 4"], (-0.095, 0.028, -0.07), (0.1, 0.05, 0.075), skip="-y")
    gltf.node("books on the table", gltf.mesh("books on the table", books), (place[0] - 0.3, top, place[2] + 0.16), turn=0.4)


def sofa(gltf, colours):
    cloth, leg = colours["mustard"], colours["walnut"]
    seat = Shape()
    seat.box(cloth, (0.0, 0.12, 0.0), (1.7, 0.30, 0.80))
    seat.box(cloth, (0.0, 0.30, 0.0), (1.7, 0.78, 0.20), skip="-y")
    for x in (0.0, 1.54):
        seat.box(cloth, (x, 0.30, 0.20), (x + 0.16, 0.56, 0.80), skip="-y -z")
    for k in range(2):
        x = 0.165 + 0.69 * k
        seat.box(cloth, (x, 0.30, 0.205), (x + 0.68, 0.43, 0.82), skip="-y")
    for x in (0.06, 1.59):
        for z in (0.06, 0.69):
            seat.box(leg, (x, 0, z), (x + 0.05, 0.12, z + 0.05), skip="-y +y")
    gltf.node("sofa", gltf.mesh("sofa", seat), (0.22, 0.0, 0.06))
    pillow = Shape()
    pillow.box(colours["teal"], (-0.2, 0, -0.06), (0.2, 0.36, 0.06), skip="-y")
    gltf.node("pillow", gltf.mesh("pillow", pillow), (0.62, 0.43, 0.36), turn=0.35)


def shelf(gltf, colours):
    """A bookcase against the right wall; its front looks along -x."""
    wood = colours["beech"]
    z0, z1, x0, x1, top, board = 0.75, 1.95, 2.70, 2.999, 1.95, 0.025
    case = Shape()
    case.box(wood, (x0, 0, z0), (x1, top, z0 + board), skip="-y +x")
    case.box(wood, (x0, 0, z1 - board), (x1, top, z1), skip="-y +x")
    levels = [0.06, 0.44, 0.82, 1.20, 1.58, top - board]
    for y in levels:
        case.box(wood, (x0, y, z0 + board), (x1, y + board, z1 - board), skip="-z +z +x")
    case.quad(colours["sage"], [(x1 - 0.01, 0, z0 + board), (x1 - 0.01, 0, z1 - board), (x1 - 0.01, top, z1 - board), (x1 - 0.01, top, z0 + board)])
    gltf.object("bookcase", case)

    for level, y in enumerate(levels[:-1]):
        row = Shape()
        z = z0 + board + 0.02 + 0.1 * hash01(level, 11)
        stop = z1 - board - (0.05, 0.45, 0.1, 0.5, 0.25)[level]
        count = 0
        while z < stop - 0.06:
            thick = 0.022 + 0.03 * hash01(level, count, 5)
            tall = 0.2 + 0.1 * hash01(level, count, 6)
            deep = 0.16 + 0.05 * hash01(level, count, 7)
            colour = colours[f"book {1 + int(5.999 * hash01(level, count, 8))}"]
            row.box(colour, (x1 - 0.02 - deep, y + board, z), (x1 - 0.02, y + board + tall, z + thick), skip="-y +x")
            z += thick + (0.001 if hash01(level, count, 9) < 0.85 else 0.05)
            count += 1
        gltf.object(f"books {level + 1}", row)

    jar = Shape()
    jar.lathe(colours["ceramic"], (2.86, 0.44 + board, 1.68), [(0.05, 0), (0.08, 0.06), (0.075, 0.14), (0.04, 0.19), (0, 0.195)], 20, smooth=True)
    gltf.object("jar", jar)
    globe = [(0.1 * math.sin(a * math.pi / 10), 0.17 - 0.1 * math.cos(a * math.pi / 10)) for a in range(11)]
    globe[0], globe[-1] = (0, globe[0][1]), (0, globe[-1][1])
    ball = Shape()
    ball.lathe(colours["teal"], (2.86, 1.20 + board, 1.66), globe, 20, smooth=True)
    ball.lathe(colours["walnut"], (2.86, 1.20 + board, 1.66), [(0.06, 0), (0.06, 0.015), (0.015, 0.03), (0.015, 0.08)], 16)
    gltf.object("globe", ball)


def lamp(gltf, colours):
    place = (2.35, 0.0, 0.45)
    stand, shade = Shape(), Shape()
    stand.lathe(colours["brass"], (0, 0, 0), [(0.15, 0), (0.15, 0.02), (0.012, 0.03), (0.012, 1.42), (0, 1.42)], 24)
    gltf.node("lamp stand", gltf.mesh("lamp stand", stand), place)
    shade.lathe(colours["shade"], (0, 0, 0), [(0, 1.36), (0.22, 1.36), (0.15, 1.66), (0, 1.66)], 28)
    gltf.node("lamp shade", gltf.mesh("lamp shade", shade), place)


def plant(gltf, colours):
    place = (2.6, 0.0, 2.3)
    pot = Shape()
    pot.lathe(colours["terracotta"], (0, 0, 0), [(0.12, 0), (0.17, 0.26), (0.19, 0.26), (0.19, 0.31), (0.165, 0.31), (0.155, 0.28)], 24)
    pot.lathe(colours["soil"], (0, 0, 0), [(0.155, 0.28), (0, 0.28)], 24)
    gltf.node("plant pot", gltf.mesh("plant pot", pot), place)
    leaves = Shape()
    for k in range(11):
        turn = 2.39996 * k
        lean = 0.25 + 0.055 * k
        length = 0.62 - 0.02 * k
        leaf(leaves, colours["leaf"], turn, lean, length)
    gltf.node("plant leaves", gltf.mesh("plant leaves", leaves), (place[0], 0.28, place[2]))


def leaf(shape, material, turn, lean, length):
    """A double-sided blade that rises and bends outward."""
    steps, half = 5, 0.045
    c, s = math.cos(turn), math.sin(turn)
    across = [-s, 0.0, c]

    def spine(t):
        bend = lean * (0.5 + 1.6 * t)
        out, up = 0.02 + length * t * math.sin(bend), length * t * math.cos(0.9 * bend)
        return [out * c, up, out * s]

    points, normals, triangles = [], [], []
    for k in range(steps + 1):
        t = k / steps
        centre = spine(t)
        normal = unit(cross(sub(spine(t + 0.01), spine(t - 0.01)), across))
        width = half * math.sin(math.pi * min(0.97, 0.12 + 0.88 * t))
        for side in (-width, width):
            points.append([centre[i] + side * across[i] for i in range(3)])
            normals.append(normal)
    for k in range(steps):
        a = 2 * k
        triangles += [(a, a + 2, a + 1), (a + 1, a + 2, a + 3)]
    shape.part(material).add(points, normals, triangles)


def pictures(gltf, colours):
    x0, x1, y0, y1 = 0.72, 1.42, 1.18, 2.0
    frame, canvas = Shape(), Shape()
    border, deep = 0.03, 0.025
    w = colours["walnut"]
    frame.box(w, (x0 - border, y0 - border, 0), (x1 + border, y0, deep), skip="-z +y")
    frame.box(w, (x0 - border, y1, 0), (x1 + border, y1 + border, deep), skip="-z -y")
    frame.box(w, (x0 - border, y0, 0), (x0, y1, deep), skip="-z -y +y")
    frame.box(w, (x1, y0, 0), (x1 + border, y1, deep), skip="-z -y +y")
    gltf.object("picture frame", frame)
    corners = [(x0, y0, 0.012), (x1, y0, 0.012), (x1, y1, 0.012), (x0, y1, 0.012)]
    canvas.quad(colours["picture"], corners, [[0, 1], [1, 1], [1, 0], [0, 0]])
    gltf.object("picture", canvas)


def rug(gltf, colours):
    x0, x1, z0, z1, y = 0.25, 2.35, 1.05, 2.45, 0.012
    shape = Shape()
    shape.box(colours["clay"], (x0, 0, z0), (x1, y, z1), skip="-y +y")
    shape.quad(colours["rug"], [(x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0)], [[0, 1], [1, 1], [1, 0], [0, 0]])
    gltf.object("rug", shape)


def room():
    gltf = Gltf()
    albedos = {
        "white": (0.80, 0.77, 0.71),
        "sage": (0.36, 0.47, 0.40),
        "walnut": (0.22, 0.115, 0.06),
        "beech": (0.58, 0.40, 0.23),
        "seat": (0.62, 0.24, 0.14),
        "mustard": (0.70, 0.42, 0.09),
        "teal": (0.06, 0.28, 0.31),
        "ceramic": (0.78, 0.76, 0.72),
        "orange": (0.83, 0.34, 0.04),
        "apple": (0.62, 0.09, 0.05),
        "clay": (0.50, 0.15, 0.08),
        "terracotta": (0.55, 0.22, 0.12),
        "soil": (0.07, 0.05, 0.035),
        "brass": (0.55, 0.40, 0.17),
        "book 1": (0.52, 0.10, 0.08),
        "book 2": (0.10, 0.22, 0.38),
        "book 3": (0.72, 0.60, 0.40),
        "book 4": (0.14, 0.32, 0.20),
        "book 5": (0.76, 0.46, 0.12),
        "book 6": (0.30, 0.16, 0.26),
    }
    colours = {name: gltf.material(name, albedo) for name, albedo in albedos.items()}
    colours["leaf"] = gltf.material("leaf", (0.10, 0.30, 0.08), double_sided=True)
    colours["oak"] = gltf.material("oak floor", 1.0, image=png(256, 256, planks))
    colours["rug"] = gltf.material("rug", 1.0, image=png(144, 96, woven))
    colours["picture"] = gltf.material("picture", 1.0, image=png(96, 120, landscape))
    colours["sky"] = gltf.material("sky", 0.0, luminance=(900.0, 1050.0, 1250.0))
    colours["shade"] = gltf.material("lamp shade", (0.8, 0.7, 0.5), luminance=(900.0, 560.0, 250.0))
    shell(gltf, colours)
    window(gltf, colours)
    rug(gltf, colours)
    table_and_chairs(gltf, colours)
    sofa(gltf, colours)
    shelf(gltf, colours)
    lamp(gltf, colours)
    plant(gltf, colours)
    pictures(gltf, colours)
    gltf.camera("camera", [1.95, 1.5, 3.9], [1.28, 0.98, 0.6], math.radians(57), 1.5)
    return gltf
