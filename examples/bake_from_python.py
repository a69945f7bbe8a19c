#!/usr/bin/env python3
"""Bakes a scene file from Python by the C interface, without any package.

    python3 bake_from_python.py SCENE.glb OUT.glb [PATH-OF-liblumel.so]
"""

import ctypes
import sys
from ctypes import POINTER, c_char_p, c_double, c_float, c_int, c_uint32, c_uint64, c_void_p


class Map(ctypes.Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("rgba", POINTER(c_float))]


class Progress(ctypes.Structure):
    _fields_ = [("stage", c_char_p), ("fraction", c_double), ("shots", c_uint64),
                ("error", c_double), ("seconds", c_double)]


ProgressFunction = ctypes.CFUNCTYPE(c_int, POINTER(Progress), c_void_p)


class Settings(ctypes.Structure):
    _fields_ = [("texels_per_metre", c_float), ("size", c_int), ("max_size", c_int),
                ("gutter", c_int), ("pages", c_int), ("sides", c_int), ("coarse_afar", c_int),
                ("density_count", c_uint32), ("densities", c_void_p), ("method", c_char_p),
                ("options", POINTER(c_char_p)), ("parts", c_int), ("directional", c_int),
                ("per_lamp", c_int), ("group_count", c_uint32), ("groups", c_void_p),
                ("weather_file", c_char_p), ("seed", c_uint32), ("error", c_double),
                ("dark_error", c_double), ("eye_error", c_double), ("visible_noise", c_double),
                ("seconds", c_double), ("shots", c_uint64), ("max_memory", c_uint64),
                ("progress", ProgressFunction), ("user", c_void_p)]


class Baked(ctypes.Structure):
    _fields_ = [("map", Map), ("directional_count", c_uint32), ("directional", POINTER(Map)),
                ("lamp_count", c_uint32), ("lamps", c_void_p), ("daylight", c_void_p),
                ("surface_count", c_uint32), ("surfaces", c_void_p), ("page_count", c_uint32),
                ("pages", c_void_p), ("note_count", c_uint32), ("notes", POINTER(c_char_p)),
                ("texels_per_metre", c_float), ("error", c_double), ("eye_error", c_double),
                ("visible_noise", c_double), ("shots", c_uint64), ("seconds", c_double),
                ("interrupted", c_int), ("internal", c_void_p)]


def load_library(path):
    lumel = ctypes.CDLL(path)
    lumel.lumel_message.restype = c_char_p
    lumel.lumel_load_scene.argtypes = [c_char_p, POINTER(c_void_p)]
    lumel.lumel_bake.argtypes = [c_void_p, c_void_p, POINTER(Settings), POINTER(POINTER(Baked))]
    lumel.lumel_write_scene.argtypes = [POINTER(Baked), c_char_p, c_int]
    lumel.lumel_free_baked.argtypes = [POINTER(Baked)]
    lumel.lumel_free_baked.restype = None
    lumel.lumel_free_scene.argtypes = [c_void_p]
    lumel.lumel_free_scene.restype = None
    return lumel


def tell(now, _):
    print(f"\r{now[0].stage.decode():20} {100 * now[0].fraction:3.0f} %", end="", file=sys.stderr)
    return 1  # go on


def main(scene_file, output, library="liblumel.so"):
    lumel = load_library(library)

    def check(result):
        if result != 0:
            sys.exit("error: " + lumel.lumel_message().decode())

    scene = c_void_p()
    check(lumel.lumel_load_scene(scene_file.encode(), ctypes.byref(scene)))
    settings = Settings(size=256, progress=ProgressFunction(tell))
    baked = POINTER(Baked)()
    check(lumel.lumel_bake(None, scene, ctypes.byref(settings), ctypes.byref(baked)))
    light = baked[0].map
    texels = light.rgba[:4 * light.width * light.height]
    lit = [green for green, alpha in zip(texels[1::4], texels[3::4]) if alpha > 0]
    print(f"\n{light.width} x {light.height} texels in {baked[0].seconds:.1f} s, "
          f"mean {sum(lit) / max(len(lit), 1):.1f} lx, error {100 * baked[0].error:.1f} %")
    check(lumel.lumel_write_scene(baked, output.encode(), 0))
    lumel.lumel_free_baked(baked)
    lumel.lumel_free_scene(scene)


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
