"""Makes a closed room as Blender exports it, walls without thickness and with both of their sides, under a sun
that comes in by a window:
    blender --background --python room.py -- FILE inside|outside
The camera is inside or outside."""

import math
import sys

import bpy

file, where = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)

bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 1.25))
room = bpy.context.object
room.scale = (4, 5, 2.5)
bpy.ops.object.transform_apply(scale=True)
bpy.ops.object.mode_set(mode='EDIT')
bpy.ops.mesh.subdivide(number_cuts=4)
bpy.ops.object.mode_set(mode='OBJECT')
window = [face for face in room.data.polygons if face.center.x > 1.9 and abs(face.center.y) < 0.6
          and 0.9 < face.center.z < 1.6]
bpy.ops.object.mode_set(mode='EDIT')
bpy.ops.mesh.select_all(action='DESELECT')
bpy.ops.object.mode_set(mode='OBJECT')
for face in window:
    face.select = True
bpy.ops.object.mode_set(mode='EDIT')
bpy.ops.mesh.delete(type='FACE')
bpy.ops.object.mode_set(mode='OBJECT')
paint = bpy.data.materials.new('paint')
paint.use_nodes = True
paint.node_tree.nodes['Principled BSDF'].inputs['Base Color'].default_value = (0.7, 0.6, 0.5, 1)
room.data.materials.append(paint)

bpy.ops.object.light_add(type='SUN', rotation=(0, math.radians(50), math.radians(20)))
bpy.context.object.data.energy = 5
place, turn = {'inside': ((-1.6, 2, 1.5), (80, 0, -140)), 'outside': ((9, -7, 5), (70, 0, 52))}[where]
bpy.ops.object.camera_add(location=place, rotation=[math.radians(angle) for angle in turn])
bpy.ops.export_scene.gltf(filepath=file, export_cameras=True, export_lights=True)
