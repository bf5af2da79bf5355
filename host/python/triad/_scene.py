"""Scenes of arrays."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _triad
from ._arguments import count, number, numbers, vector


@dataclass
class Mesh:
    """Triangles of one material, in metres, y up.

    positions: N x 3. indices: M x 3, counter-clockwise seen from the front. normals: N x 3, of any length; without them
    faces are flat. uvs: N x 2, (0, 0) being the top left corner of a texture. material: its place in the list of
    materials. to_world: 4 x 4, applied to columns (x, y, z, 1); without it the mesh stays where it is.
    """

    positions: Any
    indices: Any
    normals: Any = None
    uvs: Any = None
    material: int = 0
    to_world: Any = None
    name: str = ""

    def _arrays(self, i: int) -> _triad.Mesh:
        what = f"mesh {i}" + (f" '{self.name}'" if self.name else "")

        def attribute(name: str, values: Any, components: int) -> NDArray[np.float32] | None:
            return None if values is None else numbers(f"{name} of {what}", values, (None, components), np.float32)

        to_world = np.eye(4) if self.to_world is None else self.to_world
        return _triad.Mesh(
            self.name, numbers(f"positions of {what}", self.positions, (None, 3), np.float32),
            numbers(f"indices of {what}", self.indices, (None, 3), np.uint32, "iu"),
            attribute("normals", self.normals, 3), attribute("uvs", self.uvs, 2),
            count(f"material of {what}", self.material, least=0),
            list(numbers(f"to_world of {what}", to_world, (4, 4), np.float64).T.ravel()))


@dataclass
class Material:
    """As in glTF; all factors are in [0, 1] unless said.

    base_colour: linear R, G, B, and alpha where it is below 1. base_colour_texture: uint8, height x width x 3 or 4, sRGB,
    by which base_colour is multiplied. emission: radiance, linear R, G, B. transmission: share of the light that passes
    through; with a thickness above 0 the mesh bounds a solid body that refracts, else it is a thin sheet. ior: index of
    refraction, at least 1. double_sided: its back is like its front; else its back is not seen.
    """

    base_colour: Sequence[float] = (0.8, 0.8, 0.8)
    base_colour_texture: Any = None
    metallic: float = 0
    roughness: float = 1
    emission: Sequence[float] = (0, 0, 0)
    transmission: float = 0
    thickness: float = 0
    ior: float = 1.5
    double_sided: bool = False
    name: str = ""

    def _factors(self, i: int) -> _triad.Material:
        what = f"material {i}" + (f" '{self.name}'" if self.name else "")
        colour = np.asarray(self.base_colour)
        colour = numbers(f"base_colour of {what}", colour, (4,) if colour.shape == (4,) else (3,), np.float32)
        texture = self.base_colour_texture
        if texture is not None:
            texture = np.asarray(texture)
            if texture.dtype != np.uint8:
                raise TypeError(f"base_colour_texture of {what}: expected an array of uint8, not of {texture.dtype}")
            channels = 4 if texture.ndim == 3 and texture.shape[2] == 4 else 3
            texture = numbers(f"base_colour_texture of {what}", texture, (None, None, channels), np.uint8)
            if channels == 3:
                texture = np.dstack([texture, np.full(texture.shape[:2], 255, np.uint8)])
        return _triad.Material(
            self.name, list(colour) + [1.0] * (4 - len(colour)), texture, number(f"metallic of {what}", self.metallic),
            number(f"roughness of {what}", self.roughness), vector(f"emission of {what}", self.emission),
            number(f"transmission of {what}", self.transmission), number(f"thickness of {what}", self.thickness),
            number(f"ior of {what}", self.ior), bool(self.double_sided))


@dataclass
class Camera:
    """Looks from eye to target, in metres; fov is the vertical angle in degrees."""

    eye: Sequence[float]
    target: Sequence[float] = (0, 0, 0)
    up: Sequence[float] = (0, 1, 0)
    fov: float = 35

    def _vectors(self) -> _triad.Camera:
        return _triad.Camera(
            vector("eye of the camera", self.eye), vector("target of the camera", self.target),
            vector("up of the camera", self.up), number("fov of the camera", self.fov))


def make_scene(
    meshes: Iterable[Mesh], materials: Iterable[Material] = (), camera: Camera | None = None
) -> _triad.Scene:
    """A scene of arrays, which are copied.

    Without materials all is matte grey; without a camera the scene is framed. Throws Error that names the mesh, material
    or camera at fault.
    """
    return _triad.make_scene(
        [mesh._arrays(i) for i, mesh in enumerate(meshes)],
        [material._factors(i) for i, material in enumerate(materials)],
        None if camera is None else camera._vectors())
