# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the visible scene as a glTF with light in the units of Lumel.

Blender measures light in watts; one watt is 683 lm, the factor of Blender's own exporter:
    point and spot light of P watts    I = 683 P / 4π        cd
    sun of strength s                  E = 683 s             lx
    area light of P watts, area A      L = 683 P / (π A)     cd/m², one side; before Blender 4.0 4 A for π A
    emission and world of strength s   L = 683 s             cd/m²"""

import json
import math
import pathlib
import struct

import bpy
import mathutils

from .process import ProgramError

LUMENS_PER_WATT = 683.0
SKY_SIZE = (1024, 512)  # texels of a world that is no plain colour
SKY_SAMPLES = 16
DEFAULT_ALBEDO = 0.8
AREA_FACTOR = math.pi if bpy.app.version >= (4, 0) else 4  # watts to W/sr
FULL_SPREAD = math.pi  # of an area light that is Lambertian
STRENGTH = 'KHR_materials_emissive_strength'
LAMPS = 'KHR_lights_punctual'
AREA_LIGHTS = 'EXT_lights_area'

EXPORT_OPTIONS = {
    'export_format': 'GLB', 'export_apply': True, 'export_cameras': True, 'export_lights': True,
    'export_extras': True, 'export_animations': False, 'export_skins': False, 'export_morph': False,
    'export_yup': True, 'use_visible': True, 'use_active_scene': True, 'check_existing': False,
}


class Exported:
    """A written scene."""

    def __init__(self, path):
        self.path = path
        self.options = []  # of `lumel bake`
        self.warnings = []


def export_scene(context, folder):
    """Writes the visible objects and the world into a folder. Raises ProgramError if nothing is there to bake."""
    exported = Exported(pathlib.Path(folder) / 'scene.glb')
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    bpy.ops.export_scene.gltf(filepath=str(exported.path),
                              **{name: value for name, value in EXPORT_OPTIONS.items() if name in known})
    gltf, data = read_glb(exported.path)
    if not gltf.get('meshes'):
        raise ProgramError('There is no visible mesh to bake; show an object')
    for scene in gltf['scenes']:
        scene.pop('extras', None)  # the importer would write our settings back over those of the scene
    add_default_material(gltf)
    scale_emission(gltf)
    convert_lamps(gltf)
    add_area_lights(gltf, context, exported)
    move_densities(gltf)
    sky = write_sky(context, folder)
    if not (sky or AREA_LIGHTS in gltf.get('extensions', {}) or shining_lamps(gltf) or emitters(gltf)):
        raise ProgramError('There is no light; add a light, a material with emission, or a world that is not black')
    exported.options = sky
    write_glb(exported.path, gltf, data)
    return exported


def read_glb(path):
    """The JSON of a .glb, and its binary chunk with its header."""
    raw = pathlib.Path(path).read_bytes()
    length = struct.unpack_from('<I', raw, 12)[0]
    return json.loads(raw[20:20 + length]), raw[20 + length:]


def write_glb(path, gltf, data):
    text = json.dumps(gltf, separators=(',', ':')).encode()
    text += b' ' * (-len(text) % 4)
    with open(path, 'wb') as file:
        file.write(struct.pack('<4sIIII', b'glTF', 2, 20 + len(text) + len(data), len(text), 0x4E4F534A))
        file.write(text + data)


def use_extension(gltf, name):
    used = gltf.setdefault('extensionsUsed', [])
    if name not in used:
        used.append(name)


def add_default_material(gltf):
    """Surfaces without a material are white in glTF, but grey in Blender."""
    bare = [primitive for mesh in gltf['meshes'] for primitive in mesh['primitives'] if 'material' not in primitive]
    if not bare:
        return
    materials = gltf.setdefault('materials', [])
    for primitive in bare:
        primitive['material'] = len(materials)
    materials.append({'name': 'no material', 'doubleSided': True, 'pbrMetallicRoughness':
                      {'baseColorFactor': [DEFAULT_ALBEDO] * 3 + [1], 'metallicFactor': 0}})


def emitters(gltf):
    return [material for material in gltf.get('materials', []) if any(material.get('emissiveFactor', [0]))]


def scale_emission(gltf):
    """Emission in cd/m², also of bare Emission nodes, which some exporters write as unlit surfaces."""
    for material in gltf.get('materials', []):
        bare = bare_emission(bpy.data.materials.get(material.get('name', '')))
        if bare:
            material.get('extensions', {}).pop('KHR_materials_unlit', None)
            material['pbrMetallicRoughness'] = {'baseColorFactor': [0, 0, 0, 1], 'metallicFactor': 0}
            set_emission(material, *bare)
    for material in emitters(gltf):
        strength = material.setdefault('extensions', {}).setdefault(STRENGTH, {})
        strength['emissiveStrength'] = LUMENS_PER_WATT * strength.get('emissiveStrength', 1.0)
        use_extension(gltf, STRENGTH)


def set_emission(material, color, strength):
    emitted = [max(channel * strength, 0.0) for channel in color]
    largest = max(emitted)
    material['emissiveFactor'] = [channel / largest if largest else 0.0 for channel in emitted]
    if largest:
        material.setdefault('extensions', {})[STRENGTH] = {'emissiveStrength': largest}


def bare_emission(material):
    """Colour and strength if a material is one Emission node without textures; else None."""
    if not material or not material.use_nodes or not material.node_tree:
        return None
    for output in material.node_tree.nodes:
        if output.type == 'OUTPUT_MATERIAL' and output.is_active_output and output.inputs['Surface'].is_linked:
            return plain_emission(output.inputs['Surface'].links[0].from_node, 'EMISSION')
    return None


def plain_emission(node, kind):
    """Colour and strength of an Emission or Background node with plain values; else None."""
    if node.type != kind or any(socket.is_linked for socket in node.inputs):
        return None
    return tuple(node.inputs['Color'].default_value)[:3], node.inputs['Strength'].default_value


def light_output(light):
    """A light's colour [3] and its watts, or for suns W/m²."""
    color, power = tuple(light.color), light.energy * 2.0 ** getattr(light, 'exposure', 0.0)
    if getattr(light, 'use_temperature', False):
        color = tuple(a * b for a, b in zip(color, light.temperature_color))
    if light.use_nodes and light.node_tree:
        for node in light.node_tree.nodes:
            emission = plain_emission(node, 'EMISSION')
            if emission:
                color = tuple(a * b for a, b in zip(color, emission[0]))
                power *= emission[1]
                break
    return color, max(power, 0.0)


def lamps(gltf):
    return gltf.get('extensions', {}).get(LAMPS, {}).get('lights', [])


def shining_lamps(gltf):
    return [lamp for lamp in lamps(gltf) if lamp.get('intensity', 1) > 0 and any(lamp.get('color', [1]))]


def convert_lamps(gltf):
    """Sets intensities and sizes of lamps from their lights, whatever units the exporter has written."""
    for lamp in lamps(gltf):
        light = bpy.data.lights.get(lamp.get('name', ''))
        if not light or light.type == 'AREA':
            continue
        lamp['color'], power = light_output(light)
        extras = {}
        if light.type == 'SUN':
            lamp['intensity'] = LUMENS_PER_WATT * power
            extras['angle'] = light.angle / 2
        else:
            lamp['intensity'] = LUMENS_PER_WATT * power / (4 * math.pi)
            extras['radius'] = light.shadow_soft_size
        lamp['extras'] = extras


def add_area_lights(gltf, context, exported):
    """Adds each visible area light as a node of EXT_lights_area, in the axes of glTF."""
    to_gltf = mathutils.Matrix.Rotation(-math.pi / 2, 4, 'X')
    for instance in context.evaluated_depsgraph_get().object_instances:
        thing = instance.object
        if thing.type != 'LIGHT' or thing.data.type != 'AREA' or not is_shown(instance, context):
            continue
        light, place = thing.data, instance.matrix_world
        color, power = light_output(light)
        # A light without shadows or a portal for the sky is no surface that shines.
        if power == 0 or getattr(getattr(light, 'cycles', None), 'is_portal', False):
            continue
        if getattr(light, 'spread', FULL_SPREAD) < 0.999 * FULL_SPREAD:
            exported.warnings.append(f'{thing.name} is baked without its Spread, as if that were 180°')
        add_area_light(gltf, thing.name, light, color, power, to_gltf @ place)


def is_shown(instance, context):
    original = (instance.parent if instance.is_instance else instance.object).original
    return original.visible_get(view_layer=context.view_layer)


def add_area_light(gltf, name, light, color, power, place):
    two_sizes = light.shape in {'RECTANGLE', 'ELLIPSE'}
    stretch = place.to_scale()
    width = light.size * abs(stretch.x)
    height = (light.size_y if two_sizes else light.size) * abs(stretch.y)
    if width * height == 0:
        return
    is_round = light.shape in {'DISK', 'ELLIPSE'}
    area = width * height * (math.pi / 4 if is_round else 1)
    entry = {'name': name, 'type': 'disk' if is_round else 'rect', 'color': color, 'size': height,
             'intensity': LUMENS_PER_WATT * power / (AREA_FACTOR * area)}
    entry['extras' if is_round else 'rect'] = {'aspect': width / height}
    lights = gltf.setdefault('extensions', {}).setdefault(AREA_LIGHTS, {}).setdefault('lights', [])
    turn = rotation_of(place)
    add_root(gltf, {'name': name, 'translation': list(place.translation),
                    'rotation': [turn.x, turn.y, turn.z, turn.w],
                    'extensions': {AREA_LIGHTS: {'light': len(lights)}}})
    lights.append(entry)
    use_extension(gltf, AREA_LIGHTS)


def rotation_of(place):
    """The rotation of a transform that may mirror: its z axis stays, since lights shine along -z."""
    x, z = place.col[0].xyz, place.col[2].xyz.normalized()
    x = (x - x.dot(z) * z).normalized()
    return mathutils.Matrix((x, z.cross(x), z)).transposed().to_quaternion()


def add_root(gltf, node):
    nodes = gltf.setdefault('nodes', [])
    scene = gltf['scenes'][gltf.get('scene', 0)]
    scene.setdefault('nodes', []).append(len(nodes))
    nodes.append(node)


def move_densities(gltf):
    """Custom properties `lumel_density` of objects and meshes become Lumel's own."""
    for thing in gltf.get('nodes', []) + gltf.get('meshes', []):
        density = thing.get('extras', {}).get('lumel_density', 0) if isinstance(thing.get('extras'), dict) else 0
        if isinstance(density, (int, float)) and density > 0:
            thing['extras']['lumel'] = {'texels_per_metre': density}


def write_sky(context, folder):
    """Options of `lumel bake` for the world; none if it is black."""
    world = context.scene.world
    if not world:
        return []
    plain = tuple(world.color), 1.0
    if world.use_nodes and world.node_tree:
        output = next((node for node in world.node_tree.nodes
                       if node.type == 'OUTPUT_WORLD' and node.is_active_output), None)
        if not output or not output.inputs['Surface'].is_linked:
            return []
        plain = plain_emission(output.inputs['Surface'].links[0].from_node, 'BACKGROUND')
    if not plain:
        path = pathlib.Path(folder) / 'sky.exr'
        draw_world(world, path)
        return ['--sky', str(path), '--sky-scale', str(LUMENS_PER_WATT)]
    sky = [max(channel * plain[1], 0) * LUMENS_PER_WATT for channel in plain[0]]
    return ['--sky', ','.join(f'{channel:.6g}' for channel in sky)] if any(sky) else []


def draw_world(world, path):
    """Renders a world alone as an equirectangular panorama. Its centre is +x, as in Lumel. Raises ProgramError."""
    if not hasattr(bpy.types.Scene, 'cycles'):
        raise ProgramError('The world is no plain colour, and Cycles, which draws it, is off; enable that add-on')
    scene = bpy.data.scenes.new('Lumel sky')
    camera = bpy.data.cameras.new('Lumel sky')
    eye = bpy.data.objects.new('Lumel sky', camera)
    try:
        scene.world = world
        scene.collection.objects.link(eye)
        scene.camera = eye
        eye.rotation_euler = (math.pi / 2, 0, -math.pi / 2)  # looks along +x, up is +z
        camera.type = 'PANO'
        holder = camera if hasattr(camera, 'panorama_type') else camera.cycles
        holder.panorama_type = 'EQUIRECTANGULAR'
        render_panorama(scene, path)
    finally:
        bpy.data.scenes.remove(scene)
        bpy.data.objects.remove(eye)
        bpy.data.cameras.remove(camera)


def render_panorama(scene, path):
    render = scene.render
    render.engine = 'CYCLES'
    scene.cycles.device = 'CPU'
    scene.cycles.samples = SKY_SAMPLES
    scene.cycles.use_denoising = False
    render.resolution_x, render.resolution_y = SKY_SIZE
    render.resolution_percentage = 100
    render.film_transparent = False
    render.image_settings.file_format = 'OPEN_EXR'
    render.image_settings.color_mode = 'RGB'
    render.image_settings.color_depth = '32'
    render.filepath = str(path)
    render.use_file_extension = False
    bpy.ops.render.render(write_still=True, scene=scene.name)
