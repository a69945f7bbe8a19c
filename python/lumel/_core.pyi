"""Types of the compiled module.

All calls, and reading a Scene, block until they are done, use all cores, and run one at a time. They raise Error;
ValueError and TypeError for arguments of the wrong shape, range or type; and whatever a progress function raises.
bake(), LiveLinks.update() and LiveScene.update() check for Ctrl-C, the others once they are done.
"""

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .content import Instance, Light, Material, Mesh, Vector

_Path = Union[str, os.PathLike[str]]
_Angles = tuple[float, float]
_Sides = Literal["automatic", "both", "brighter", "front"]
_Factor = Union[float, np.floating[Any], Vector]
_Floats = NDArray[np.float32]
_Indices = NDArray[np.uint32]

__version__: str

class Error(RuntimeError):
    """The message is one sentence: location, fault and remedy."""

    kind: Literal["input", "device", "output", "stopped"]

class LumelWarning(UserWarning):
    """A message for the user; also in Scene.warnings, Baked.notes and LiveLinks.notes."""

class Progress:
    @property
    def stage(self) -> str: ...
    @property
    def fraction(self) -> float:
        """Of the stage, 0 to 1."""
    @property
    def shots(self) -> int: ...
    @property
    def error(self) -> float:
        """Estimated relative error; below 0: unknown."""
    @property
    def seconds(self) -> float:
        """Since the stage began."""

class DeviceInfo:
    """A Vulkan device of this machine."""

    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str:
        """"discrete", "integrated", "virtual", "cpu" or "other"."""
    @property
    def api_version(self) -> str:
        """Such as "1.3.230"."""
    @property
    def driver(self) -> str:
        """Name and version."""
    @property
    def memory_bytes(self) -> int:
        """Size of the largest device-local heap."""
    @property
    def usable(self) -> bool: ...
    @property
    def reason(self) -> str:
        """Why the device is not usable, else empty."""

def list_devices() -> list[DeviceInfo]:
    """All Vulkan devices of this machine, as `lumel devices` lists them."""

class Device:
    """A Vulkan device, for methods other than "links", rays on a GPU and directional maps."""

    def __init__(self, pick: str = "") -> None:
        """pick: index or part of a name, as `lumel devices` lists; empty: the best."""
    @property
    def name(self) -> str: ...
    @property
    def info(self) -> DeviceInfo: ...

class Scene:
    """A checked scene. Its arrays are copied."""

    def __init__(self, *, meshes: Iterable[Mesh], instances: Iterable[Instance], materials: Iterable[Material],
                 lights: Iterable[Light] = (), textures: Iterable[NDArray[np.uint8]] = (),
                 sky: Optional[ArrayLike] = None) -> None:
        """textures: (height, width, 4) of dtype uint8, colours sRGB-coded. sky: (height, width, 3) luminance [cd/m²]
        over all directions; row 0 is up, the middle of the image is +x, and +z is at three quarters of its width."""
    @staticmethod
    def load(path: _Path, *, materials: Literal["diffuse", "glossy"] = "diffuse") -> Scene:
        """Reads a glTF 2.0 file. "glossy": for method "glossy"."""
    def add_daylight(self, *, sun: Optional[_Angles] = None, sky_luminance: Optional[Vector] = None,
                     sky_file: Optional[_Path] = None, cie: Optional[int] = None, cie_lux: Optional[float] = None,
                     cie_sun: Optional[_Angles] = None, sky_scale: float = 1.0, ground: float = 0.0,
                     rotation: float = 0.0) -> None:
        """Replaces the sky, and adds the sun as a light. Suns: azimuth clockwise from north (-z), seen from above,
        and elevation. cie: type 1 to 16 of a standard sky, with cie_lux (10,000 by default) on an open horizontal
        plane. ground: albedo below the horizon."""
    @property
    def instances(self) -> list[str]:
        """Names of the visible ones."""
    @property
    def transforms(self) -> _Floats:
        """(n, 4, 4), mesh to world, for columns, of the instances; a new array."""
    @property
    def lights(self) -> list[str]:
        """Names."""
    @property
    def warnings(self) -> list[str]: ...
    def find_instance(self, name: str) -> int:
        """Index of the first instance with this name."""

class Surface:
    """One primitive of one instance in the lightmap, or its back. Vertices are split at chart borders. Arrays are views
    of the bake's memory, which they keep alive."""

    @property
    def instance(self) -> int: ...
    @property
    def primitive(self) -> int: ...
    @property
    def back(self) -> bool:
        """True for the back of the preceding surface: the same triangles with reversed winding."""
    @property
    def texels_per_metre(self) -> float: ...
    @property
    def source_vertex(self) -> _Indices:
        """(V,) the source primitive's vertex."""
    @property
    def lightmap(self) -> _Floats:
        """(V, 2) coordinates in 0 to 1, (0, 0) at the top left."""
    @property
    def indices(self) -> _Indices:
        """(3 T,) without triangles of zero area."""
    @property
    def page(self) -> NDArray[np.uint16]:
        """(V,) index into the pages; empty if there is one page."""

class DaylightHour:
    """An hour of the year with light. Arrays are views of the bake's memory, which they keep alive."""

    @property
    def hour(self) -> str:
        """"06-21T12": from 12 to 13 o'clock on 21 June, local standard time."""
    @property
    def sun(self) -> _Floats:
        """(3,) unit direction to the sun in the middle of the hour."""
    @property
    def lux(self) -> float:
        """Illuminance by direct sun on a plane that faces it [lx]."""
    @property
    def mean(self) -> float:
        """Mean illuminance of all surfaces, without direct sun [lx]."""
    @property
    def error(self) -> float:
        """Estimated, relative to the light of the hour."""
    @property
    def weights(self) -> _Floats:
        """(K,) of DaylightMaps.maps, signed: their sum is the light of the hour without direct sun."""

class DaylightMaps:
    """Daylight over a year, whatever lights the scene has, as K maps. Direct sun is in none of them. Arrays are views of
    the bake's memory, which they keep alive."""

    @property
    def place(self) -> str:
        """Name in the weather file."""
    @property
    def latitude(self) -> float:
        """North, in radians."""
    @property
    def longitude(self) -> float:
        """East, in radians."""
    @property
    def error(self) -> float:
        """Of the sums, due to their number of maps: RMS over all hours, relative."""
    @property
    def maps(self) -> dict[str, _Floats]:
        """(height, width, 4), as Baked.map, by their hours, in the order of the weights."""
    @property
    def hours(self) -> dict[str, DaylightHour]:
        """Those with light, by their names, in the order of the calendar; a new dictionary."""

class Baked:
    """A finished bake. Arrays are views of its memory, which they keep alive."""

    @property
    def map(self) -> _Floats:
        """(height, width, 4) irradiance [lx], and above 0 where a surface is. write_scene() writes your changes."""
    @property
    def directional(self) -> list[_Floats]:
        """4 or 9 maps of coefficients of the incoming radiance [cd/m²]."""
    @property
    def lamps(self) -> dict[str, _Floats]:
        """With per_lamp: maps of single lamps and groups by name, which add up to the map."""
    @property
    def daylight(self) -> Optional[DaylightMaps]:
        """With weather_file. None also if progress ended the bake before, or no daylight reaches a surface."""
    @property
    def surfaces(self) -> list[Surface]: ...
    @property
    def pages(self) -> list[tuple[int, int, int]]:
        """Left, top and side [texels] of each."""
    @property
    def texels_per_metre(self) -> float: ...
    @property
    def error(self) -> float:
        """Estimated relative error; this and the next two: below 0 if unknown."""
    @property
    def eye_error(self) -> float: ...
    @property
    def visible_noise(self) -> float: ...
    @property
    def shots(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def interrupted(self) -> bool:
        """Ended by progress."""
    @property
    def relightable(self) -> bool:
        """True if Relight can use it: method "matrix", all parts."""
    @property
    def notes(self) -> list[str]: ...

def bake(scene: Scene, *, device: Optional[Device] = None, progress: Optional[Callable[[Progress], Any]] = None,
         texels_per_metre: Optional[float] = None, size: Optional[int] = None, max_size: Optional[int] = None,
         gutter: Optional[int] = None, pages: Optional[int] = None, sides: Optional[_Sides] = None,
         densities: Optional[Mapping[str, float]] = None, coarse_afar: Optional[bool] = None,
         method: Optional[str] = None, options: Optional[Mapping[str, str]] = None,
         parts: Optional[Literal["all", "direct", "indirect"]] = None,
         directional: Optional[Literal["none", "sh1", "sh2"]] = None, per_lamp: Optional[bool] = None,
         groups: Optional[Mapping[str, str]] = None, weather_file: Optional[_Path] = None, seed: Optional[int] = None,
         error: Optional[float] = None, dark_error: Optional[float] = None, eye_error: Optional[float] = None,
         visible_noise: Optional[float] = None, seconds: Optional[float] = None, shots: Optional[int] = None,
         max_memory: Optional[int] = None) -> Baked:
    """Returns the map that `lumel bake` writes with the same settings, without a device that of `--rays host`.

    progress: called often; returning False ends the bake with the best light so far, other values are ignored. Settings
    are those of BakeSettings and AtlasSettings in lumel.h; None stands for the default. densities: texels per metre by
    names of nodes, meshes or materials, with shell wildcards; the last match applies. groups: patterns of lamps by the
    name of their group. weather_file: an EPW file, for Baked.daylight.
    """

def probes(baked: Baked, places: ArrayLike, *,
           samples: int = 4096) -> tuple[_Floats, NDArray[np.float64], NDArray[np.bool_]]:
    """Incoming light at points (n, 3) [m]: coefficients (n, 9, 3) in real spherical harmonics [cd/m²], their standard
    error (n,), and True (n,) where a point is inside an object."""

def write_scene(path: _Path, baked: Baked, *, lightmap: Literal["ktx2", "rgb9e5", "png", "none"] = "ktx2") -> None:
    """Writes the scene with Baked.map to a .glb file, as scene.glb of `lumel bake`."""

def write_baked_scene(path: _Path, baked: Baked, *, size: int = 2048) -> None:
    """Writes a .glb file that any viewer shows lit, with textures of at most `size` texels a side."""

class LiveLinksState:
    @property
    def residual(self) -> float: ...
    @property
    def dark_residual(self) -> float: ...
    @property
    def under_way(self) -> bool: ...
    @property
    def at_rest(self) -> bool: ...
    @property
    def milliseconds(self) -> float: ...

class LiveLinks:
    """Keeps a scene lit while instances and lamps move, lamps are dimmed and colours change. Runs on the CPU."""

    def __init__(self, scene: Scene, *, movers: Optional[Iterable[int]] = None,
                 rays: Optional[Literal[4, 16, 64, 256]] = None, filter: Optional[bool] = None,
                 seed: Optional[int] = None, residual: Optional[float] = None,
                 texels_per_metre: Optional[float] = None, size: Optional[int] = None, max_size: Optional[int] = None,
                 gutter: Optional[int] = None, pages: Optional[int] = None, sides: Optional[_Sides] = None,
                 densities: Optional[Mapping[str, float]] = None, coarse_afar: Optional[bool] = None) -> None:
        """movers: movable instances. rays: stored for each lumel. Settings are those of LiveLinksSettings and
        AtlasSettings in lumel.h; None stands for the default."""
    def move(self, instance: int, transform: ArrayLike) -> None:
        """(4, 4), mesh to world, for columns; a rigid motion. update() applies it."""
    def move_lamp(self, name: str, *, position: Optional[Vector] = None,
                  direction: Optional[Vector] = None) -> None: ...
    def set_lamp(self, name: str, factor: _Factor) -> None:
        """Scales lights, and emission of materials, of this name, relative to the scene."""
    def set_sky(self, factor: _Factor) -> None: ...
    def set_color(self, material: str, color: Vector) -> None: ...
    def update(self, budget_ms: float = ...) -> LiveLinksState:
        """Runs for about this time; by default until the light has converged."""
    @property
    def state(self) -> LiveLinksState:
        """After the last update()."""
    def bake(self, error: float = 0.02) -> float:
        """Solves the scene as it is now to this estimated relative error, as bake() does, and returns that reached.
        map() and lumels() then have this light until the next change."""
    def map(self) -> _Floats:
        """(height, width, 4), as Baked.map; a new array."""
    def lumels(self) -> _Floats:
        """(height, width, 4) irradiance [lx] without gutters and seams, in little time, and 1 where a lumel is; of two
        sides in one texel, the front. A new array."""
    @property
    def surfaces(self) -> list[Surface]: ...
    @property
    def notes(self) -> list[str]: ...

class LiveState:
    @property
    def residual(self) -> float:
        """Unshot light relative to all light."""
    @property
    def under_way(self) -> bool:
        """A move is not completely redistributed yet."""
    @property
    def at_rest(self) -> bool: ...
    @property
    def milliseconds(self) -> float: ...

class LiveScene:
    """Keeps a scene lit while instances move and lamps change, by shooting on a GPU."""

    def __init__(self, device: Device, scene: Scene, *, movers: Optional[Iterable[int]] = None,
                 redistribution: Optional[Literal["incremental", "cross"]] = None, seed: Optional[int] = None,
                 residual: Optional[float] = None, texels_per_metre: Optional[float] = None,
                 size: Optional[int] = None, max_size: Optional[int] = None, gutter: Optional[int] = None,
                 pages: Optional[int] = None, sides: Optional[_Sides] = None,
                 densities: Optional[Mapping[str, float]] = None, coarse_afar: Optional[bool] = None) -> None:
        """movers: movable instances. Settings are those of LiveSettings and AtlasSettings in lumel.h; None stands for
        the default. The light is computed by update()."""
    def move(self, instance: int, transform: ArrayLike) -> None:
        """(4, 4), mesh to world, for columns; a rigid motion. update() applies it."""
    def set_emission(self, instance: int, factor: _Factor) -> None:
        """Scales the emission of an instance relative to the scene."""
    def set_reflectance(self, instance: int, factor: _Factor) -> None:
        """Scales the reflectance of an instance relative to the scene; the result is clamped to 0 to 1."""
    def set_light(self, light: int, factor: _Factor) -> None:
        """Scales a light, an index into Scene.lights."""
    def set_sky(self, factor: _Factor) -> None: ...
    def update(self, budget_ms: float = ...) -> LiveState:
        """Applies moves, then shoots for about this time; by default until the light has converged."""
    @property
    def state(self) -> LiveState:
        """After the last update()."""
    def map(self) -> _Floats:
        """(height, width, 4), as Baked.map, after the last move that is completely redistributed; a new array."""
    @property
    def surfaces(self) -> list[Surface]: ...
    @property
    def notes(self) -> list[str]: ...

class Relight:
    """A baked scene under any light, by one matrix product. All factors are initially 1."""

    @overload
    def __init__(self, device: Device, baked: Baked) -> None:
        """Of a bake with method "matrix"."""
    @overload
    def __init__(self, device: Device, path: _Path) -> None:
        """Of scene.lumelmat, written by save() or `lumel bake --solver matrix`. Its maps have filled gutters; seams and
        buried texels are not corrected."""
    @property
    def lights(self) -> list[str]:
        """Names of the sources: lights, emissive instances, "sky"."""
    def set_light(self, name: str, factor: _Factor) -> None:
        """Scales a source, or all emission of a material of this name, relative to the bake."""
    def move_light(self, name: str, *, position: Optional[Vector] = None,
                   direction: Optional[Vector] = None) -> None:
        """Moves or turns a lamp; what is left out is as baked. Not for a file, which has no scene."""
    def map(self) -> _Floats:
        """(height, width, 4), as Baked.map, for the current factors and lamp positions; a new array."""
    def save(self, path: _Path) -> None:
        """Writes scene.lumelmat."""
