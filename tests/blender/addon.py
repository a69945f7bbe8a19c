"""Installs the add-on and runs one of its checks:
    blender --background --python addon.py -- ZIP LUMEL FOLDER CHECK
Prints the error of each light's irradiance against Cycles. CHECK: name of one of the functions check_…"""

import importlib
import math
import pathlib
import sys
import threading
import time

import bpy
import numpy

LUMENS_PER_WATT = 683
ACCURACY = 0.01  # of irradiance against Cycles
HEIGHT = 2.0  # of lights above the plane [m]
SIDE = 0.1  # of the plane [m]

archive, lumel, folder, chosen = sys.argv[sys.argv.index('--') + 1:]
folder = pathlib.Path(folder)


IS_EXTENSION = bpy.app.version >= (4, 2)
MODULE = 'bl_ext.user_default.lumel' if IS_EXTENSION else 'lumel'


def install():
    if IS_EXTENSION:
        bpy.ops.extensions.package_install_files(filepath=archive, repo='user_default')
    else:
        bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module=MODULE)
    preferences().program = lumel


def preferences():
    return bpy.context.preferences.addons[MODULE].preferences


def clear():
    """An empty scene without a file; the add-on stays."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    if MODULE not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module=MODULE)
    preferences().program = lumel
    bpy.context.scene.lumel.quality = 'draft'


def expect(truth, message):
    if not truth:
        raise AssertionError(message)


def bake():
    expect(bpy.ops.lumel.bake('EXEC_DEFAULT') == {'FINISHED'}, 'the bake has not finished')


def refusal():
    """What the add-on says of a bake that it refuses."""
    try:
        bpy.ops.lumel.bake('EXEC_DEFAULT')
    except RuntimeError as error:
        return str(error)
    raise AssertionError('the bake was not refused')


def result():
    return bpy.context.scene.lumel.result


def baked_object(name):
    """The one object of the result whose name begins so: Blender numbers names that are taken."""
    things = [thing for thing in result().all_objects if thing.type == 'MESH' and thing.name.startswith(name)]
    expect(len(things) == 1, f'{len(things)} objects {name} in the result')
    return things[0]


def lightmap():
    """The lightmap [height, width, RGBA]."""
    images = {node.image for thing in result().all_objects if thing.type == 'MESH' for material in thing.data.materials
              if material.node_tree for node in material.node_tree.nodes if node.type == 'TEX_IMAGE'}
    image = next(image for image in images if image.name.startswith('lightmap'))
    values = numpy.empty(image.size[0] * image.size[1] * 4, numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


def irradiance(thing):
    """Mean irradiance [lx, RGB] of a flat object of the result, over the covered texels of its lightmap."""
    texels, uv = lightmap(), thing.data.uv_layers['UVMap.001'].data
    size = numpy.array([texels.shape[1], texels.shape[0]])
    corners = numpy.array([entry.uv[:] for entry in uv]) * size
    low, high = numpy.floor(corners.min(0)).astype(int), numpy.ceil(corners.max(0)).astype(int)
    part = texels[low[1]:high[1], low[0]:high[0]].reshape(-1, 4)
    return (part[:, :3] * part[:, 3:]).sum(0) / part[:, 3].sum()


def material(name, color=(0.8, 0.8, 0.8), emission=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    inputs = made.node_tree.nodes['Principled BSDF'].inputs
    inputs['Base Color'].default_value = (*color, 1)
    inputs['Specular' if 'Specular' in inputs else 'Specular IOR Level'].default_value = 0  # diffuse, as in Lumel
    if emission:
        inputs['Emission' if 'Emission' in inputs else 'Emission Color'].default_value = (*emission[0], 1)
        inputs['Emission Strength'].default_value = emission[1]
    return made


def white_world(strength, color=(1, 1, 1)):
    world = bpy.data.worlds.new('world')
    world.use_nodes = True
    world.node_tree.nodes['Background'].inputs['Color'].default_value = (*color, 1)
    world.node_tree.nodes['Background'].inputs['Strength'].default_value = strength
    bpy.context.scene.world = world
    return world


def picture(camera, samples, name, width, height, bounces=64):
    """What Cycles sends to the camera [W/(sr m²)], as [height, width, RGB]."""
    scene = bpy.context.scene
    scene.camera = camera
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = bounces
    scene.cycles.sample_clamp_indirect = 0
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = 'OPEN_EXR'
    scene.render.image_settings.color_depth = '32'
    scene.render.filepath = str(folder / f'{name}.exr')
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    values = numpy.array(image.pixels[:]).reshape(height, width, 4)[:, :, :3]
    bpy.data.images.remove(image)
    return values


def coarse(values):
    """Means of 10 × 10 pixels, in which the noise of paths is small."""
    height, width, channels = values.shape
    return values.reshape(height // 10, 10, width // 10, 10, channels).mean((1, 3))


# --- units: what a small plane at the origin receives

def add_light(kind, energy, **settings):
    bpy.ops.object.light_add(type=kind, location=(0, 0, HEIGHT))
    light = bpy.context.object
    light.data.energy = energy
    for name, value in settings.items():
        setattr(light.data, name, value)
    return light


def add_panel(look):
    bpy.ops.mesh.primitive_plane_add(size=0.5, location=(0, 0, HEIGHT), rotation=(math.pi, 0, 0))
    bpy.context.object['lumel_density'] = 10.0  # its own light does not matter
    bpy.context.object.data.materials.append(look)


def emissive_panel(**settings):
    add_panel(material('shining', (0, 0, 0), **settings))


def emission_node():
    made = bpy.data.materials.new('bare')
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.remove(nodes['Principled BSDF'])
    emission = nodes.new('ShaderNodeEmission')
    emission.inputs['Color'].default_value = (1, 0.5, 0.25, 1)
    emission.inputs['Strength'].default_value = 7
    made.node_tree.links.new(emission.outputs[0], nodes['Material Output'].inputs['Surface'])
    add_panel(made)


def sky_node():
    """A world that is no plain colour: brighter towards one side, where it is warm."""
    nodes = white_world(2).node_tree.nodes
    links = bpy.context.scene.world.node_tree.links
    gradient, place = nodes.new('ShaderNodeTexGradient'), nodes.new('ShaderNodeTexCoord')
    links.new(place.outputs['Generated'], gradient.inputs['Vector'])
    ramp = nodes.new('ShaderNodeValToRGB')
    ramp.color_ramp.elements[1].color = (1, 0.6, 0.3, 1)
    links.new(gradient.outputs['Fac'], ramp.inputs['Fac'])
    links.new(ramp.outputs['Color'], nodes['Background'].inputs['Color'])


def tilted_area():
    light = add_light('AREA', 80, shape='RECTANGLE', size=0.6, size_y=0.2, color=(1, 0.8, 0.5))
    light.location = (0.8, 0.3, 1.5)
    light.rotation_euler = (0.2, 0.5, 0.3)
    light.scale = (1.5, 2, 1)


UNITS = {
    'point, 100 W': lambda: add_light('POINT', 100, shadow_soft_size=0.05),
    'spot, 100 W': lambda: add_light('SPOT', 100, shadow_soft_size=0.05),
    'sun, 3 W/m²': lambda: add_light('SUN', 3),
    'square, 100 W': lambda: add_light('AREA', 100, shape='SQUARE', size=1),
    'rectangle, 100 W': lambda: add_light('AREA', 100, shape='RECTANGLE', size=1.5, size_y=0.4),
    'disk, 100 W': lambda: add_light('AREA', 100, shape='DISK', size=1),
    'ellipse, 100 W': lambda: add_light('AREA', 100, shape='ELLIPSE', size=1.2, size_y=0.6),
    'tilted, scaled, tinted rectangle, 80 W': tilted_area,
    'emission of strength 5': lambda: emissive_panel(emission=((1, 1, 1), 5)),
    'tinted emission of strength 0.5': lambda: emissive_panel(emission=((1, 0.5, 0.2), 0.5)),
    'Emission node of strength 7': emission_node,
    'world of strength 0.5': lambda: white_world(0.5, (0.5, 0.8, 1)),
    'world of a gradient': sky_node,
}


def received_by_cycles():
    """Irradiance [W/m², RGB] of the plane: π / albedo times what its middle sends to a camera above it."""
    plane = bpy.data.objects['receiver']
    white = bpy.data.materials.new('white')
    white.use_nodes = True
    nodes = white.node_tree.nodes
    diffuse = nodes.new('ShaderNodeBsdfDiffuse')
    diffuse.inputs['Color'].default_value = (1, 1, 1, 1)
    white.node_tree.links.new(diffuse.outputs[0], nodes['Material Output'].inputs['Surface'])
    plane.data.materials.clear()
    plane.data.materials.append(white)
    bpy.ops.object.camera_add(location=(0, 0, 1))
    camera = bpy.context.object
    camera.data.type = 'ORTHO'
    camera.data.ortho_scale = SIDE / 2  # pixels at the edge would mix in what is beside the plane
    return math.pi * picture(camera, 1024, 'plane', 16, 16, bounces=0).mean((0, 1))


def check_units():
    worst = 0
    for name, add in UNITS.items():
        clear()
        bpy.ops.mesh.primitive_plane_add(size=SIDE)
        bpy.context.object.name = 'receiver'
        add()
        scene = bpy.context.scene
        scene.lumel.density, scene.lumel.quality = 80, 'good'
        bake()
        lux = irradiance(baked_object('receiver'))
        bpy.ops.lumel.remove()
        watts = received_by_cycles()
        error = numpy.abs(lux / (LUMENS_PER_WATT * watts) - 1).max()
        worst = max(worst, error)
        print(f'addon: {name}: {lux.mean():.1f} lx, {100 * error:.2f} % from Cycles')
    expect(worst < ACCURACY, f'a light is {100 * worst:.2f} % off')


# --- a room

def make_room():
    """A room with a coloured wall, boxes and an area light under the ceiling."""
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 1.25))
    room = bpy.context.object
    room.name = 'Zimmer für Gäste'
    room.scale = (4, 5, 2.5)
    room.data.materials.append(material('paint', (0.7, 0.6, 0.5)))
    room.data.flip_normals()
    bpy.ops.mesh.primitive_cube_add(size=0.8, location=(0.7, 0.5, 0.4))
    bpy.context.object.name = 'box'
    bpy.context.object.data.materials.append(material('red', (0.7, 0.1, 0.1)))
    light = add_light('AREA', 60, shape='RECTANGLE', size=0.6, size_y=0.4)
    light.location.z = 2.4
    light.name = 'ceiling light'
    bpy.ops.object.camera_add(location=(-1.8, -2.3, 1.5), rotation=(math.radians(80), 0, math.radians(-38)))
    bpy.context.scene.camera = bpy.context.object
    return room


def counts():
    """Numbers of data-blocks of each kind."""
    return {kind: len(getattr(bpy.data, kind))
            for kind in ('objects', 'meshes', 'materials', 'images', 'collections', 'cameras', 'lights', 'actions')}


def visible():
    bpy.context.view_layer.update()
    return sorted(thing.name for thing in bpy.context.view_layer.objects if thing.visible_get())


def check_room():
    """The result looks as Cycles shows the originals, and goes without a trace."""
    room = make_room()
    before = visible()
    bpy.context.scene.lumel.quality = 'good'
    camera = bpy.context.scene.camera
    paths = coarse(picture(camera, 64, 'paths', 160, 90))
    expect(not bpy.data.filepath, 'the test should run on a file that was never saved')
    blocks = counts()
    bake()
    expect(not room.visible_get() and room.hide_render, 'the originals are still shown')
    baked = coarse(picture(camera, 16, 'baked', 160, 90))
    difference = numpy.abs(baked - paths).mean() / paths.mean()
    brightness = baked.mean() / paths.mean()
    print(f'addon: room: brightness {brightness:.3f} of Cycles, mean difference {100 * difference:.1f} %')
    # The Principled BSDF is not quite Lambertian, and in Lumel the lamp absorbs light.
    expect(abs(brightness - 1) < 0.04 and difference < 0.05, 'the room looks otherwise')

    scene = bpy.context.scene
    scene.lumel.view = 'original'
    expect(visible() == before, f'Original shows {visible()}, not {before}')
    scene.lumel.view = 'baked'
    expect(not room.visible_get(), 'Baked shows the originals')
    bpy.ops.lumel.remove()
    expect(visible() == before and counts() == blocks, f'{blocks} have become {counts()}')

    bake()
    bpy.data.collections.remove(result())  # by hand
    bpy.ops.lumel.remove()
    expect(visible() == before, 'the originals stay hidden after their result was deleted')


def check_again():
    """A second bake replaces the first, of the originals; hidden objects stay hidden."""
    room = make_room()
    bpy.ops.mesh.primitive_cube_add(size=0.2, location=(0, -1, 1))
    bpy.context.object.hide_set(True)
    bake()
    first = lightmap()
    once = counts()
    bake()
    expect(numpy.array_equal(first, lightmap()), 'the same scene bakes otherwise')
    expect(counts() == once, f'{once} have become {counts()}')
    bpy.data.lights[0].energy *= 2
    guest = bpy.data.objects.new('guest', None)
    result().objects.link(guest)
    bake()
    expect(guest.name == 'guest', 'an object that was put into the collection by hand is deleted')
    expect(abs(lightmap()[:, :, :3].sum() / first[:, :, :3].sum() - 2) < 0.02, 'twice the light is not twice as bright')
    bpy.ops.lumel.remove()
    expect(room.visible_get() and not bpy.data.objects['Cube'].visible_get(), 'visibility is not as it was')


def cancel_once(key, wanted):
    """Ends the next bake as soon as its progress has this key."""
    ui = importlib.import_module(f'{MODULE}.ui')

    def watch():
        while not (ui.Running.bake and key in ui.Running.bake.progress):
            time.sleep(0.1)
        ui.cancel(wanted=wanted)
    threading.Thread(target=watch, daemon=True).start()


def check_kept():
    """A bake that is cancelled, fails or is refused leaves the old result; one that is stopped shows its light."""
    make_room()
    bake()
    old, shown = result(), visible()
    preferences().program = '/nowhere/lumel'
    expect('no program lumel at /nowhere/lumel' in refusal(), 'a missing program is not told')
    preferences().program = '/bin/true'
    expect('is not lumel' in refusal(), 'a program that is none is not told')
    failing = folder / 'failing'
    failing.write_text('#!/bin/sh\n[ "$1" = --version ] && { echo lumel 0.1.0; exit; }\n'
                       'echo error: no disk >&2; exit 3\n')
    failing.chmod(0o755)
    preferences().program = str(failing)
    expect('no disk' in refusal(), 'the error of the program is not shown')
    preferences().program = lumel
    settings = bpy.context.scene.lumel
    settings.quality, settings.density = 'fine', 30

    cancel_once('stage', wanted=False)
    expect(bpy.ops.lumel.bake('EXEC_DEFAULT') == {'CANCELLED'}, 'the bake was not cancelled')
    expect(result() == old and visible() == shown, 'the old result has changed')
    first = lightmap().shape
    settings.folder = str(folder / 'stopped')
    cancel_once('error', wanted=True)
    bake()
    expect(lightmap().shape != first and lightmap()[:, :, :3].max() > 0, 'the light so far is not shown')
    old = result()
    cancel_once('stage', wanted=True)
    expect('before the first result' in refusal() and result() == old, 'files of a former bake are taken for new ones')


def check_refused():
    """What is missing is said in a sentence, and nothing changes."""
    expect('no visible mesh' in refusal(), 'an empty scene is not told')
    bpy.ops.mesh.primitive_plane_add(size=1)
    expect('no light' in refusal(), 'a scene without light is not told')
    white_world(0)
    expect('no light' in refusal(), 'a black world is taken for light')
    bpy.context.scene.lumel.folder = '//out'
    white_world(1)
    expect('not saved yet' in refusal(), 'a relative folder without a file is not told')
    bpy.context.scene.lumel.folder = str(folder / 'kept files')
    bake()
    for name in ('lightmap.exr', 'scene.glb', 'preview.png'):
        expect((folder / 'kept files' / name).exists(), f'{name} was not kept')


def check_objects():
    """Linked meshes, instanced collections and curves are baked; a density of one object's own is kept."""
    white_world(1)
    bpy.ops.mesh.primitive_plane_add(size=1, location=(0, 0, -1))
    plane = bpy.context.object
    plane.name = 'Fläche Nr. 1'
    plane.data.materials.append(material('one-sided'))
    plane.data.materials[0].use_backface_culling = True
    twin = plane.copy()  # a linked duplicate
    twin.location.x = 3
    bpy.context.collection.objects.link(twin)
    bpy.ops.curve.primitive_bezier_circle_add(radius=0.5, location=(0, 3, 0))
    bpy.context.object.name = 'tube'
    bpy.context.object.data.bevel_depth = 0.1
    group = bpy.data.collections.new('group')
    bpy.ops.mesh.primitive_cube_add(size=0.5)
    cube = bpy.context.object
    bpy.context.collection.objects.unlink(cube)
    group.objects.link(cube)
    for x in (-3, -5):
        holder = bpy.data.objects.new('instance', None)
        holder.instance_type, holder.instance_collection = 'COLLECTION', group
        holder.location.x = x
        bpy.context.collection.objects.link(holder)
    bpy.context.scene.lumel.density = 10
    twin['lumel_density'] = 40.0
    bake()
    meshes = [thing for thing in result().all_objects if thing.type == 'MESH']
    expect(len(meshes) == 5, f'{len(meshes)} of 5 objects in the result')
    for thing in meshes:
        expect(thing.visible_get(), f'{thing.name} is hidden')
    sides = sorted(numpy.ptp([entry.uv.x for entry in thing.data.uv_layers['UVMap.001'].data])
                   for thing in meshes if len(thing.data.polygons) <= 2)
    expect(len(sides) == 2 and 3.5 < sides[1] / sides[0] < 4.5, f'widths of the planes in the map: {sides}')
    up = irradiance(min((thing for thing in meshes if len(thing.data.polygons) <= 2),
                        key=lambda thing: thing.matrix_world.translation.x))
    expect(abs(up.mean() / (math.pi * LUMENS_PER_WATT) - 1) < 0.1, f'{up} lx under an open sky of 1 W/(sr m²)')


install()
clear()
globals()[f'check_{chosen}']()
print(f'addon: {chosen} passed')
