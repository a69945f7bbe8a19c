"""Scenes made in memory: the classes that Scene() takes, as in glTF 2.0."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = Union[Sequence[float], NDArray[Any]]
NONE = -1


@dataclasses.dataclass
class Material:
    """Textures are indices into those of the scene, or NONE; they repeat, and use texcoords."""

    name: str = ""
    base_color: Vector = (0.8, 0.8, 0.8, 1.0)  # 0 to 1; RGB is the diffuse reflectance
    base_color_texture: int = NONE
    emitted: Vector = (0.0, 0.0, 0.0)  # luminance [cd/m²]
    emitted_texture: int = NONE
    metallic: float = 0.0  # this and the next two: method "glossy" only
    roughness: float = 1.0
    metallic_roughness_texture: int = NONE
    alpha: Literal["opaque", "mask", "blend"] = "opaque"
    alpha_cutoff: float = 0.5
    transmission: float = 0.0  # share of the light that passes, without refraction
    double_sided: bool = False


@dataclasses.dataclass
class Primitive:
    """Triangles of one material, front faces counter-clockwise. Arrays are copied."""

    positions: ArrayLike  # (V, 3) [m]
    indices: ArrayLike  # 3 of each triangle, in any shape
    material: int = 0  # index into the materials of the scene
    normals: Optional[ArrayLike] = None  # (V, 3); none: flat
    texcoords: Optional[ArrayLike] = None  # (V, 2)
    lightmap: Optional[ArrayLike] = None  # (V, 2) your own layout in 0 to 1, used unless it overlaps
    colors: Optional[ArrayLike] = None  # (V, 4) linear; they multiply the base colour


@dataclasses.dataclass
class Mesh:
    primitives: Sequence[Primitive]
    name: str = ""


def _identity() -> NDArray[np.float32]:
    return np.eye(4, dtype=np.float32)


@dataclasses.dataclass
class Instance:
    """A placed mesh, with texels of its own."""

    mesh: int = 0  # index into the meshes of the scene
    name: str = ""
    transform: ArrayLike = dataclasses.field(default_factory=_identity)  # (4, 4), for columns: M @ (x, y, z, 1)


@dataclasses.dataclass
class Light:
    kind: Literal["point", "spot", "directional"] = "point"
    name: str = ""
    color: Vector = (1.0, 1.0, 1.0)
    intensity: float = 1.0  # [cd]; directional: [lx]
    position: Vector = (0.0, 0.0, 0.0)  # [m]
    direction: Vector = (0.0, -1.0, 0.0)  # of its light, any length
    range: float = 0.0  # maximum distance of its light [m]; 0: unlimited
    inner_cone: float = 0.0  # half angles of a spot
    outer_cone: float = 0.785398
    radius: float = 0.0  # of a ball [m]; 0: a point, sharp shadows
    angle: float = 0.0  # angular radius of a directional light
