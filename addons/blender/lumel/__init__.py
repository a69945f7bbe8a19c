# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes the light of a scene into a lightmap with the program `lumel`."""

bl_info = {  # for Blender before 4.2; later ones read blender_manifest.toml
    'name': 'Lumel',
    'author': 'Lumel contributors',
    'version': (0, 1, 0),
    'blender': (3, 4, 0),
    'location': 'Properties > Render > Lumel, and the sidebar of the 3D view',
    'description': 'Bakes lightmaps by radiosity, with an estimated error',
    'category': 'Render',
}


def register():
    from . import ui
    ui.register()


def unregister():
    from . import ui
    ui.unregister()
