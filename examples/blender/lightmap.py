"""Shows a baked scene in Blender, and draws a picture of it with Cycles:
    blender --background --python lightmap.py -- FOLDER PICTURE [WIDTH HEIGHT [baked]]
FOLDER: what `lumel bake` has written; baked: by its scene-baked.glb, which needs no lightmap."""

import json
import math
import pathlib
import sys

import bpy


def give(links, source, to):
    """Connects an input with an output, with a value, or with whatever another input gets."""
    if isinstance(source, bpy.types.NodeSocket) and not source.is_output:
        source = source.links[0].from_socket if source.is_linked else source.default_value
    if isinstance(source, bpy.types.NodeSocket):
        links.new(source, to)
    elif to.type == 'VECTOR':
        to.default_value = [source] * 3 if isinstance(source, float) else source[:3]
    else:
        to.default_value = source


def light_by_map(material, image):
    """The surface sends its emission [cd/m²] and albedo × H / π of the image's H [lx], and is lit by nothing else."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    surface = next((node.inputs for node in nodes if node.type == 'BSDF_PRINCIPLED'), None)
    if not surface:
        return  # KHR_materials_unlit
    output = next(node for node in nodes if node.type == 'OUTPUT_MATERIAL')

    def node(kind, *inputs, **settings):
        made = nodes.new(kind)
        for name, value in settings.items():
            setattr(made, name, value)
        for source, to in zip(inputs, made.inputs):
            give(links, source, to)
        return made.outputs[0]

    place = node('ShaderNodeUVMap', uv_map='UVMap.001')  # TEXCOORD_1
    arriving = node('ShaderNodeTexImage', place, image=image)
    emission = surface['Emission' if 'Emission' in surface else 'Emission Color']
    emitted = node('ShaderNodeVectorMath', emission, surface['Emission Strength'], operation='MULTIPLY')
    albedo = surface['Base Color']
    reflected = node('ShaderNodeVectorMath', albedo, arriving, operation='MULTIPLY')
    sent = node('ShaderNodeVectorMath', reflected, 1 / math.pi, emitted, operation='MULTIPLY_ADD')
    shown = node('ShaderNodeMixShader', surface['Alpha'], node('ShaderNodeBsdfTransparent'),
                 node('ShaderNodeEmission', sent))
    links.new(shown, output.inputs['Surface'])


def part_sides(mesh, distance):
    """Moves faces apart that coincide: the two sides of one surface, where each has light of its own."""
    def corners(face):
        return frozenset(mesh.vertices[i].co[:] for i in face.vertices)

    seen, twice = set(), set()
    for face in mesh.polygons:
        (twice if corners(face) in seen else seen).add(corners(face))
    moved = {i for face in mesh.polygons if corners(face) in twice for i in face.vertices}
    for i, normal in [(i, mesh.vertices[i].normal.copy()) for i in moved]:
        mesh.vertices[i].co += distance * normal


def load_lit_scene(folder):
    """Imports scene.glb of a bake, lit by lightmap.exr, and sets the scene's exposure."""
    folder = pathlib.Path(folder).resolve()
    bpy.ops.import_scene.gltf(filepath=str(folder / 'scene.glb'))
    image = bpy.data.images.load(str(folder / 'lightmap.exr'))
    image.colorspace_settings.name = 'Non-Color'  # lx, linear
    image.alpha_mode = 'NONE'  # alpha is coverage
    for material in bpy.data.materials:
        if 'lumel' in material:  # what scene.glb says of its lightmap, in extras
            light_by_map(material, image)
    for mesh in bpy.data.meshes:
        part_sides(mesh, 1e-4)  # [m]

    # White paint that receives H lx sends H / π, and shows as AgX of exposure × H.
    report = json.loads((folder / 'report.json').read_text())
    view = bpy.context.scene.view_settings
    view.view_transform = 'AgX' if bpy.app.version >= (4, 0) else 'Standard'  # Standard clips highlights
    view.exposure = math.log2(math.pi * report['solution']['exposure'])


def load_baked_scene(folder):
    """Imports scene-baked.glb, whose surfaces send what preview.png shows."""
    bpy.ops.import_scene.gltf(filepath=str(pathlib.Path(folder).resolve() / 'scene-baked.glb'))
    for mesh in bpy.data.meshes:
        part_sides(mesh, 1e-4)  # [m]
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
    scene.render.filepath = str(pathlib.Path(picture).resolve())
    bpy.ops.render.render(write_still=True)


if __name__ == '__main__':
    folder, picture, *size = sys.argv[sys.argv.index('--') + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if size and size[-1] == 'baked':
        load_baked_scene(folder)
    else:
        load_lit_scene(folder)
    draw(picture, *map(int, size[:2] or (1280, 720)))
