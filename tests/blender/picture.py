"""Draws a picture of a baked scene with Cycles:
    blender --background --python picture.py -- ADDON FOLDER PICTURE WIDTH HEIGHT [baked]
ADDON: the folder of the add-on. FOLDER: from `lumel bake`. baked: by its scene-baked.glb, which has no lightmap."""

import json
import math
import pathlib
import sys

import bpy


def load_lit_scene(result, folder):
    """Shows the lightmap as emission in cd/m² and sets the scene's exposure."""
    result.lit_blocks(folder, 1)
    # White paint that receives H lx sends H / π, and shows as AgX of exposure × H.
    report = json.loads((folder / 'report.json').read_text())
    view = bpy.context.scene.view_settings
    view.view_transform = 'AgX' if bpy.app.version >= (4, 0) else 'Standard'  # Standard clips highlights
    view.exposure = math.log2(math.pi * report['solution']['exposure'])


def load_baked_scene(result, folder):
    """Imports scene-baked.glb, whose surfaces send what preview.png shows."""
    for block in result.import_gltf(folder / 'scene-baked.glb'):
        if isinstance(block, bpy.types.Mesh):
            result.part_sides(block, result.SHIFT)
    bpy.context.scene.view_settings.view_transform = 'Standard'


def draw(picture, width, height):
    """Draws what the scene's first camera sees."""
    scene = bpy.context.scene
    scene.camera = next(thing for thing in bpy.data.objects if thing.type == 'CAMERA')
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = 16  # for edges: the rest has no noise
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.filepath = str(picture)
    bpy.ops.render.render(write_still=True)


addon, folder, picture, width, height, *kind = sys.argv[sys.argv.index('--') + 1:]
sys.path.insert(0, str(pathlib.Path(addon).resolve().parent))
from lumel import result as result_module  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
load = load_baked_scene if kind == ['baked'] else load_lit_scene
load(result_module, pathlib.Path(folder).resolve())
draw(pathlib.Path(picture).resolve(), int(width), int(height))
