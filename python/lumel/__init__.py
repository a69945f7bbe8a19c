"""Radiosity lightmaps as numpy arrays.

    import lumel

    scene = lumel.Scene.load("room.glb")
    baked = lumel.bake(scene, texels_per_metre=20)
    baked.map  # (height, width, 4) irradiance [lx], and above 0 where a surface is

Units are metres, radians, lx, cd/m² and cd; +y is up; colours are linear Rec. 709.
"""

from ._core import (
    Baked, DaylightHour, DaylightMaps, Device, DeviceInfo, Error, LiveLinks, LiveLinksState, LiveScene, LiveState,
    LumelWarning, Progress, Relight, Scene, Surface, __version__, bake, list_devices, probes, write_baked_scene, write_scene)
from .content import NONE, Instance, Light, Material, Mesh, Primitive
from .pages import cut_page

__all__ = [
    "NONE", "Baked", "DaylightHour", "DaylightMaps", "Device", "DeviceInfo", "Error", "Instance", "Light", "LiveLinks",
    "LiveLinksState", "LiveScene", "LiveState", "LumelWarning", "Material", "Mesh", "Primitive", "Progress", "Relight", "Scene", "Surface",
    "__version__", "bake", "cut_page", "list_devices", "probes", "write_baked_scene", "write_scene"]
