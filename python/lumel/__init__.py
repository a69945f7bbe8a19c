"""Radiosity lightmaps as numpy arrays.

    import lumel

    scene = lumel.Scene.load("room.glb")
    baked = lumel.bake(scene, texels_per_metre=20)
    baked.map  # (height, width, 4) irradiance [lx], and above 0 where a surface is

Units are metres, radians, lx, cd/m² and cd; +y is up; colours are linear Rec. 709.
"""

from ._core import (
    Baked, Device, Error, LiveLinks, LiveLinksState, LumelWarning, Progress, Scene, Surface,
    __version__, bake, probes, write_baked_scene, write_scene)
from .content import NONE, Instance, Light, Material, Mesh, Primitive

__all__ = [
    "NONE", "Baked", "Device", "Error", "Instance", "Light", "LiveLinks", "LiveLinksState", "LumelWarning",
    "Material", "Mesh", "Primitive", "Progress", "Scene", "Surface", "__version__", "bake", "probes",
    "write_baked_scene", "write_scene"]
