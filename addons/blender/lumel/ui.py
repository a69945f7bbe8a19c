# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels, operators and settings."""

import pathlib
import shutil
import tempfile

import bpy

from . import export, result
from .process import STOPPED, Bake, ProgramError, check_program, find_program

TICK = 0.2  # seconds between looks at a running bake

QUALITIES = [
    ('draft', 'Draft', 'Noise of 1 % on plain walls: clouds and grain show'),
    ('good', 'Good', 'Noise of 0.5 %: clean at first sight'),
    ('fine', 'Fine', 'Noise of 0.2 %: clean at three times the size'),
]
SIDES = [(str(side), str(side), f'At most {side} × {side} texels') for side in (512, 1024, 2048, 4096)]
VIEWS = [('baked', 'Baked', 'Show the lightmap'), ('original', 'Original', 'Show your objects and lights')]


class Running:
    """The bake that runs now, of which there is at most one."""
    bake = None
    text = ''
    wanted = True  # False: its light is to be dropped


class LumelPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name='Program', subtype='FILE_PATH',
        description='Path of the program lumel; empty: the one of the search path')

    def draw(self, context):
        self.layout.prop(self, 'program')
        try:
            self.layout.label(text=f'Found: {find_program(self.program)}')
        except ProgramError as error:
            self.layout.label(text=str(error), icon='ERROR')


class LumelHidden(bpy.types.PropertyGroup):
    """An original that the baked scene hides, and whether it was visible."""
    object: bpy.props.PointerProperty(type=bpy.types.Object)
    eye: bpy.props.BoolProperty()
    render: bpy.props.BoolProperty()


def switch_view(self, context):
    result.show(context, baked=self.view == 'baked')


class LumelSettings(bpy.types.PropertyGroup):
    quality: bpy.props.EnumProperty(name='Quality', items=QUALITIES, default='good')
    density: bpy.props.FloatProperty(
        name='Texels per Metre', default=16, min=0.1, soft_max=100,
        description='Density of the lightmap; the custom property lumel_density of an object overrides it')
    largest: bpy.props.EnumProperty(
        name='Largest Map', items=SIDES, default='2048',
        description='Side of the lightmap at most; the density is lowered to fit')
    folder: bpy.props.StringProperty(
        name='Save Files in', subtype='DIR_PATH',
        description='Folder for lightmap.exr, scene.glb and the other files of the bake; empty: keep none')
    view: bpy.props.EnumProperty(name='Result', items=VIEWS, default='baked', update=switch_view)
    result: bpy.props.PointerProperty(type=bpy.types.Collection)
    hidden: bpy.props.CollectionProperty(type=LumelHidden)


def folder_of(settings):
    """The folder for the files of the bake, or None. Raises ProgramError."""
    if not settings.folder:
        return None
    if settings.folder.startswith('//') and not bpy.data.filepath:
        raise ProgramError('"Save Files in" is relative to the .blend file, which is not saved yet; save it, '
                           'or choose another folder')
    return pathlib.Path(bpy.path.abspath(settings.folder))


def time_of(path):
    """When a file was written; None if there is none."""
    return path.stat().st_mtime_ns if path.exists() else None


def command_of(program, exported, out, settings, previews):
    """The command line of a bake. Without previews, files that only other programs read are small."""
    small = [] if previews else ['--baked-size', '64', '--preview-width', '0']
    return [program, 'bake', str(exported.path), str(out), '--quality', settings.quality,
            '--texels-per-metre', f'{settings.density:g}', '--max-size', settings.largest,
            '--progress', 'json', '--quiet', *small, *exported.options]


class LUMEL_OT_bake(bpy.types.Operator):
    """Bake the light of all visible objects into a lightmap"""
    bl_idname = 'lumel.bake'
    bl_label = 'Bake'
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        return Running.bake is None

    def execute(self, context):
        return self._begin(context) or self._wait(context)

    def invoke(self, context, event):
        failed = self._begin(context)
        if failed:
            return failed
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type == 'ESC' and event.value == 'PRESS':
            cancel(wanted=False)
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        if not Running.bake:  # the add-on was switched off
            self._end_modal(context)
            return {'CANCELLED'}
        running = Running.bake.poll()
        Running.text = str(Running.bake)
        context.window_manager.progress_update(100 * Running.bake.progress.get('fraction', 0))
        redraw(context)
        if running:
            return {'PASS_THROUGH'}
        self._end_modal(context)
        return self._finish(context)

    def cancel(self, context):  # the window closes
        cancel(wanted=False)
        self._end_modal(context)
        self._clear()

    def _end_modal(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()

    def _begin(self, context):
        """Exports the scene and starts the bake. Returns a result only if that fails."""
        self._temporary = pathlib.Path(tempfile.mkdtemp(prefix='lumel-', dir=bpy.app.tempdir or None))
        self._scene = context.scene.name
        try:
            settings = context.scene.lumel
            program = find_program(context.preferences.addons[__package__].preferences.program)
            check_program(program)
            folder = folder_of(settings)
            self._out = folder or self._temporary / 'out'
            self._former = time_of(self._out / 'scene.glb')
            exported = export_originals(context, self._temporary)
            for warning in exported.warnings:
                self.report({'WARNING'}, warning)
            Running.wanted = True
            Running.bake = Bake(command_of(program, exported, self._out, settings, folder is not None))
            Running.text = str(Running.bake)
        except (ProgramError, RuntimeError, OSError) as error:
            return self._fail(str(error))
        return None

    def _wait(self, context):
        while Running.bake.poll():
            Running.bake.wait(TICK)
        return self._finish(context)

    def _finish(self, context):
        """Loads the result of a bake that has ended."""
        bake, wanted = Running.bake, Running.wanted
        if not wanted:
            self._clear()
            self.report({'INFO'}, 'Bake cancelled; nothing has changed')
            return {'CANCELLED'}
        # A bake that is stopped early writes nothing.
        if bake.exit_code not in (0, STOPPED) or time_of(self._out / 'scene.glb') == self._former:
            return self._fail(bake.messages[-1] if bake.messages else
                              f'lumel ended with exit code {bake.exit_code} and no message')
        try:
            to_scene(context, self._scene)
            to_object_mode(context)
            result.place_result(context, self._out)
        except ProgramError as error:
            return self._fail(str(error))
        for message in bake.messages:
            self.report({'WARNING'}, message)
        self.report({'INFO'}, f'Baked in {bake.seconds():.0f} s' +
                    (', with the light so far' if bake.exit_code == STOPPED else ''))
        self._clear()
        return {'FINISHED'}

    def _fail(self, message):
        self._clear()
        self.report({'ERROR'}, message)
        return {'CANCELLED'}

    def _clear(self):
        Running.bake = None
        Running.text = ''
        shutil.rmtree(self._temporary, ignore_errors=True)


def export_originals(context, folder):
    """Exports the scene as it is without its result."""
    to_object_mode(context)
    baked = result.is_there(context.scene) and context.scene.lumel.view == 'baked'
    if baked:
        result.show(context, baked=False)
    try:
        return export.export_scene(context, folder)
    finally:
        if baked:
            result.show(context, baked=True)


def to_scene(context, name):
    """Back to the scene of the bake, if another one is shown now."""
    if name not in bpy.data.scenes:
        raise ProgramError('The scene of the bake is gone; bake again')
    if context.scene.name != name:
        context.window.scene = bpy.data.scenes[name]


def to_object_mode(context):
    """Edits of a mesh are in its data only once its edit mode has ended."""
    if context.mode != 'OBJECT' and bpy.ops.object.mode_set.poll():
        bpy.ops.object.mode_set(mode='OBJECT')


def cancel(wanted):
    Running.wanted = wanted
    if Running.bake:
        Running.bake.stop()


@bpy.app.handlers.persistent
def forget(*_):
    """Another file is loaded: its scene is not that of the bake."""
    cancel(wanted=False)
    Running.bake = None


def redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {'PROPERTIES', 'VIEW_3D'}:
                area.tag_redraw()


class LUMEL_OT_stop(bpy.types.Operator):
    """End the bake"""
    bl_idname = 'lumel.stop'
    bl_label = 'Cancel'

    keep: bpy.props.BoolProperty(name='Keep', description='Show the light so far')

    @classmethod
    def poll(cls, context):
        return Running.bake is not None

    @classmethod
    def description(cls, context, properties):
        return 'End the bake and show the light so far' if properties.keep else \
            'End the bake and leave the scene as it was'

    def execute(self, context):
        cancel(wanted=self.keep)
        return {'FINISHED'}


class LUMEL_OT_remove(bpy.types.Operator):
    """Delete the baked scene and show the originals"""
    bl_idname = 'lumel.remove'
    bl_label = 'Remove'
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        return result.is_there(context.scene)

    def execute(self, context):
        result.remove_result(context)
        return {'FINISHED'}


class Panel:
    bl_label = 'Lumel'

    def draw(self, context):
        layout, settings = self.layout, context.scene.lumel
        layout.use_property_split = True
        layout.use_property_decorate = False
        if Running.bake:
            draw_running(layout)
        else:
            layout.operator('lumel.bake', icon='LIGHT_AREA')
        column = layout.column()
        column.enabled = Running.bake is None
        column.prop(settings, 'quality', expand=True)
        column.prop(settings, 'density')
        column.prop(settings, 'largest')
        column.prop(settings, 'folder')
        if result.is_there(context.scene):
            layout.row().prop(settings, 'view', expand=True)
            layout.operator('lumel.remove', icon='TRASH')


def draw_running(layout):
    text, left = Running.text, Running.bake.seconds_left()
    if left is not None:
        text += f', {left:.0f} s left'
    if hasattr(layout, 'progress'):  # Blender 4.0
        layout.progress(text=text, factor=Running.bake.progress.get('fraction', 0))
    else:
        layout.label(text=text)
    layout.operator('lumel.stop', text='Cancel', icon='CANCEL').keep = False
    row = layout.row()
    row.enabled = 'error' in Running.bake.progress  # there is no light before
    row.operator('lumel.stop', text='Use Light So Far', icon='CHECKMARK').keep = True


class LUMEL_PT_render(Panel, bpy.types.Panel):
    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    bl_context = 'render'


class LUMEL_PT_view(Panel, bpy.types.Panel):
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = 'Lumel'


CLASSES = (LumelPreferences, LumelHidden, LumelSettings, LUMEL_OT_bake, LUMEL_OT_stop, LUMEL_OT_remove,
           LUMEL_PT_render, LUMEL_PT_view)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.lumel = bpy.props.PointerProperty(type=LumelSettings)
    bpy.app.handlers.load_pre.append(forget)


def unregister():
    forget()
    bpy.app.handlers.load_pre.remove(forget)
    del bpy.types.Scene.lumel
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
