# SPDX-License-Identifier: GPL-3.0-or-later
"""The baked scene in Blender: a collection of its own, whose materials show the lightmap as emission."""

import math
import pathlib

import bpy

from .export import LUMENS_PER_WATT
from .process import ProgramError

COLLECTION = 'Lumel'
OWN = 'lumel_result'  # custom property of the objects of a result
SHIFT = 1e-4  # metres between the two sides of one surface
DATA = ('objects', 'meshes', 'materials', 'images', 'textures', 'cameras', 'lights', 'collections', 'actions')


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


def light_by_map(material, image, scale):
    """The surface sends emission + albedo × H / π, times `scale`, of the image's H [lx], and is lit by nothing else."""
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

    texel = node('ShaderNodeUVMap', uv_map='UVMap.001')  # TEXCOORD_1
    irradiance = node('ShaderNodeTexImage', texel, image=image)
    emission = surface['Emission' if 'Emission' in surface else 'Emission Color']
    emitted = node('ShaderNodeVectorMath', emission, surface['Emission Strength'], operation='MULTIPLY')
    albedo = surface['Base Color']
    reflected = node('ShaderNodeVectorMath', albedo, irradiance, operation='MULTIPLY')
    sent = node('ShaderNodeVectorMath', reflected, 1 / math.pi, emitted, operation='MULTIPLY_ADD')
    shown = node('ShaderNodeMixShader', surface['Alpha'], node('ShaderNodeBsdfTransparent'),
                 node('ShaderNodeEmission', sent, scale))
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


def everything():
    return {block for name in DATA for block in getattr(bpy.data, name)}


def import_gltf(path):
    """Imports a glTF; returns the set of new data-blocks."""
    import numpy
    if 'bool' not in numpy.__dict__:  # the importer of Blender 3.4 names it, NumPy 1.24 has it no longer
        numpy.bool = bool
    before = everything()
    try:
        bpy.ops.import_scene.gltf(filepath=str(path))
    except BaseException:
        discard(everything() - before)
        raise
    return everything() - before


def discard(blocks):
    """Removes data-blocks, first those that use others."""
    for name in DATA:
        doomed = [block for block in getattr(bpy.data, name) if block in blocks]
        if doomed:
            bpy.data.batch_remove(doomed)


def load_map(path):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = 'Non-Color'  # lx, linear
    image.alpha_mode = 'NONE'  # alpha is coverage
    image.pack()  # the file may be temporary
    return image


def lit_blocks(folder, scale):
    """Imports scene.glb of a bake, lit by lightmap.exr; returns its data-blocks. scale: of all light."""
    folder = pathlib.Path(folder)
    blocks = import_gltf(folder / 'scene.glb')
    try:
        image = load_map(folder / 'lightmap.exr')
        blocks.add(image)
        for block in blocks:
            if isinstance(block, bpy.types.Material) and 'lumel' in block:  # what scene.glb says of its lightmap
                light_by_map(block, image, scale)
            elif isinstance(block, bpy.types.Mesh):
                part_sides(block, SHIFT)
    except BaseException:
        discard(blocks)
        raise
    return blocks


def place_result(context, folder):
    """Shows the bake of a folder in place of the former one, which stays if this fails. Raises ProgramError."""
    try:
        blocks = lit_blocks(folder, 1 / LUMENS_PER_WATT)
    except (RuntimeError, OSError) as error:
        raise ProgramError(f'The result of the bake cannot be loaded: {error}') from error
    collection = bpy.data.collections.new(COLLECTION)
    gather(blocks, collection)
    remove_result(context)
    collection.name = COLLECTION
    context.scene.collection.children.link(collection)
    context.scene.lumel.result = collection
    context.scene.lumel.view = 'baked'  # calls show()
    for thing in context.selected_objects:  # the importer selects what it makes
        thing.select_set(False)
    context.view_layer.objects.active = None


def gather(blocks, collection):
    """Moves the imported meshes and their parents to a collection; deletes what is left of cameras and lights."""
    objects = [block for block in blocks if isinstance(block, bpy.types.Object)]
    parents = {thing.parent for thing in objects}
    for thing in objects:
        for holder in thing.users_collection:
            holder.objects.unlink(thing)
        if thing.type == 'MESH' or thing in parents:
            collection.objects.link(thing)
            thing[OWN] = True
    discard({thing for thing in objects if not thing.users_collection} |
            {block for block in blocks if isinstance(block, (bpy.types.Camera, bpy.types.Light))})


def is_there(scene):
    """True with a result, or if its collection was deleted by hand and the originals are still hidden."""
    return scene.lumel.result is not None or len(scene.lumel.hidden) > 0


def layer_collection(context):
    """The result's collection in the view layer; None without a result."""
    result = context.scene.lumel.result
    return result and context.view_layer.layer_collection.children.get(result.name)


def show(context, baked):
    """Shows the baked scene and hides the originals, or the reverse."""
    state, result = context.scene.lumel, context.scene.lumel.result
    for entry in state.hidden:
        if entry.object:
            set_hidden(entry.object, entry.eye, entry.render)
    state.hidden.clear()
    layer = layer_collection(context)
    if layer:
        layer.exclude = not baked
    if not (layer and baked):
        return
    own = set(result.all_objects)
    for thing in context.view_layer.objects:
        if thing in own or thing.type == 'CAMERA' or (thing.hide_render and not thing.visible_get()):
            continue
        entry = state.hidden.add()
        entry.object, entry.eye, entry.render = thing, thing.hide_get(), thing.hide_render
        set_hidden(thing, True, True)


def set_hidden(thing, eye, render):
    try:
        thing.hide_set(eye)
        thing.hide_render = render
    except (RuntimeError, AttributeError):
        pass  # not in this view layer, or linked from a file that cannot be edited


def remove_result(context):
    """Deletes the baked scene and shows the originals."""
    show(context, baked=False)
    result = context.scene.lumel.result
    if not result:
        return
    context.scene.lumel.result = None
    for thing in [thing for thing in result.objects if OWN not in thing]:  # put there by hand
        context.scene.collection.objects.link(thing)
        result.objects.unlink(thing)
    things = {thing for thing in result.objects if OWN in thing}
    meshes = {thing.data for thing in things if thing.type == 'MESH'}
    materials = {slot for mesh in meshes for slot in mesh.materials if slot}
    images = {node.image for material in materials if material.node_tree
              for node in material.node_tree.nodes if node.type == 'TEX_IMAGE' and node.image}
    discard(things | {result})
    for blocks in (meshes, materials, images):  # each is used by the former
        discard({block for block in blocks if block.users == 0})
