"""Triad: path tracing of glTF scenes and of arrays on any OpenCL device.

    import triad
    film = triad.render("scene.glb", width=640, height=360, spp=64)
    film.image                  # numpy float32, 360 x 640 x 3, linear
    film.write("scene.png")

Options are those of the command line (docs/command-line.md), with underscores for dashes: ``max_depth=4``,
``env="sky.hdr"``, ``look_at=(2, 1, 3, 0, 0, 0)``, ``adaptive=True``. Numbers that the command line joins may be a
tuple or an array; a list of strings gives an option several times; None leaves it out.

What goes wrong in Triad is a ``triad.Error``; arguments that cannot be right are a ``TypeError`` or ``ValueError``.
"""
from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from . import _triad
from ._arguments import count, image, number, words
from ._scene import Camera, Material, Mesh, make_scene
from ._triad import CheckResult, Comparison, Device, Error, Panel, Perceived, Progress, Scene

__version__: str = _triad.version()
__all__ = [
    "Camera", "CheckResult", "Comparison", "Device", "Error", "Film", "Material", "Mesh", "Panel", "Perceived", "Progress",
    "Scene", "check", "compare", "devices", "load", "load_film", "make_scene", "merge", "panels", "perceived",
    "read_image", "render", "resolve", "set_verbosity",
]

Path = Union[str, "os.PathLike[str]"]
Picture = Union["NDArray[Any]", Path]


class Film:
    """A picture before exposure, tone map and reconstruction, with all that is known of it; it does not change.

    Options of its pictures are those of ``triad resolve``: exposure, tonemap, background, denoise, bits, half,
    reconstruct, filter, panel and so on. What was given to render() holds unless it is given again.
    """

    def __init__(self, film: _triad.Film) -> None:
        self._film = film
        self._image: NDArray[np.float32] | None = None

    @property
    def width(self) -> int:
        """Pixels, of the crop where there is one."""
        return self._film.width

    @property
    def height(self) -> int:
        """Pixels, of the crop where there is one."""
        return self._film.height

    @property
    def spp(self) -> float:
        """Samples per pixel: their mean where pixels differ."""
        return self._film.spp

    @property
    def relmse(self) -> float | None:
        """Estimated mean of (x - r)^2 / (r^2 + 0.01), r being the picture of endless samples; None: not known."""
        return self._film.relmse

    @property
    def complete(self) -> bool:
        """The goal was reached: the render was not stopped by its progress function."""
        return self._film.complete

    @property
    def metadata(self) -> dict[str, str]:
        """What the picture says of itself: triad:spp, triad:device, triad:seconds, triad:settings and so on."""
        return self._film.metadata

    @property
    def image(self) -> NDArray[np.float32]:
        """float32, height x width x 3, or 4 with alpha: what an EXR file holds. Linear Rec. 709, from the top row on."""
        if self._image is None:
            self._image = self._film.image([])
        return self._image

    @property
    def layers(self) -> dict[str, NDArray[np.float32]]:
        """float32, height x width, of every layer that option aov of render() asked for: "albedo.R", "depth.Z" ..."""
        return self._film.layers

    def bitmap(self, **options: Any) -> NDArray[np.uint8] | NDArray[np.uint16]:
        """uint8 (uint16 with bits=16), height x width x 3 or 4: what a PNG file holds, tone-mapped and sRGB-encoded."""
        return self._film.bitmap(words(options))

    def write(self, path: Path | Sequence[Path], **options: Any) -> None:
        """Writes pictures by their extensions: .exr and .hdr (linear), .png and .jpg (tone-mapped).

        EXR files get the layers. Throws Error.
        """
        paths = [path] if isinstance(path, (str, os.PathLike)) else list(path)
        self._film.write([os.fspath(each) for each in paths], words(options))

    def encode(self, extension: str, **options: Any) -> bytes:
        """The bytes of such a file; the extension is ".png", ".jpg", ".hdr" or ".exr" (without layers)."""
        return self._film.encode(extension, words(options))

    def save(self, path: Path) -> None:
        """Writes a film file: for load_film(), ``triad merge`` and ``triad resolve``."""
        self._film.save(os.fspath(path))

    def _repr_png_(self) -> bytes:
        return self.encode(".png")

    def __repr__(self) -> str:
        error = "" if self.relmse is None else f", relMSE {self.relmse:.2g}"
        return f"<triad.Film {self.width}x{self.height}, {self.spp:g} samples per pixel{error}>"


def load(path: Path, **options: Any) -> Scene:
    """Reads a .gltf or .glb file. Options: scene, variant, animation, pose_time, strict, max_texture. Throws Error."""
    return _triad.load(os.fspath(path), words(options))


def render(
    scene: Scene | Path | None = None,
    width: int | None = None,
    height: int | None = None,
    spp: int | None = None,
    seed: int = 0,
    device: str | int = "",
    progress: Callable[[Progress], object] | None = None,
    **settings: Any,
) -> Film:
    """Renders a scene, a file (options of load() go with the settings), or the built-in scene.

    width, height: pixels, or neither: 720 rows in the aspect of the camera.
    spp: samples per pixel; without it 64, or as settings error and time want.
    device: number, "cpu", "gpu", part of a name, or "all".
    progress: called some times a second with a Progress; False stops the render, whose film is then not complete. An
        exception stops it and comes out of render(); so does Ctrl-C, as KeyboardInterrupt.
    settings: all other options of ``triad render``.

    Other threads of Python run meanwhile. The first render on a device compiles and checks its kernels, which takes up
    to a minute and is kept. Throws Error.
    """
    if scene is None:
        scene = Scene()
    elif not isinstance(scene, Scene):
        scene = os.fspath(scene)
    film = _triad.render(
        scene, count("width", width), count("height", height), None if spp is None else count("spp", spp),
        count("seed", seed, least=0), str(device), words(settings), progress)
    return Film(film)


def load_film(path: Path, device: str | int = "") -> Film:
    """Reads a film file; its pictures are made on `device`. Throws Error."""
    return Film(_triad.load_film(os.fspath(path), str(device)))


def merge(films: Iterable[Film]) -> Film:
    """Joins films of one picture with different samples; in any order the same bits. Throws Error."""
    return Film(_triad.merge([film._film for film in films]))


def read_image(path: Path) -> NDArray[np.float32]:
    """float32, height x width x 3 or 4, of an EXR, HDR, PNG or JPEG file; of the latter two sRGB values in [0, 1]."""
    return _triad.read_image(os.fspath(path))[0]


def resolve(source: Film | Picture, **options: Any) -> NDArray[np.float32]:
    """Pixels of a film again, or of any renderer's larger picture, whose pixels are then the bins.

    Options are those of ``triad resolve``: ``panel="qd-oled"``, ``filter="mitchell"``, ``bins=(3, 3)``. Returns
    float32, height x width x 3 or 4: linear values; for a panel what it shows, in [0, 1]. Throws Error.
    """
    if isinstance(source, Film):
        return source._film.image(words(options))
    return _triad.reconstruct(*image("source", source), words(options))


def compare(picture: Film | Picture, reference: Film | Picture) -> Comparison:
    """How far a picture is from a reference: rmse, relmse, mae, psnr and flip, over the channels that both have.

    Pictures are films, files, or arrays of height x width x 3 or 4; arrays of uint8 and uint16 hold sRGB values. Throws
    Error for pictures of different sizes.
    """
    return _triad.compare(*_pixels("picture", picture), *_pixels("reference", reference))


def perceived(
    drives: Film | Picture, reference: Film | Picture, panel: str, ppd: float | None = None, eye: str = "scielab"
) -> Perceived:
    """What an eye sees of the difference between what a panel shows and what it should show.

    drives: what the panel is driven with, as resolve(film, panel=...) makes it. reference: what there is to be seen, in
    [0, 1], n x n pixels for each of the panel's, n at least 3. ppd: pixels per degree; without it the panel's, or 45.
    eye: "scielab", "sharp" or "flip". Throws Error.
    """
    return _triad.perceived(
        *_pixels("drives", drives), *_pixels("reference", reference), panel, number("ppd", ppd or 0), eye)


def _pixels(what: str, picture: Film | Picture) -> tuple[NDArray[np.float32], bool]:
    return image(what, picture.image if isinstance(picture, Film) else picture)


def devices() -> list[Device]:
    """Every OpenCL device, and why one is not usable."""
    return _triad.devices()


def panels() -> list[Panel]:
    """The built-in displays. Each also turned ("qd-oled@90") or mirrored ("rgb@flip")."""
    return _triad.panels()


def check(
    device: str | int = "",
    level: str = "standard",
    cases: Sequence[str] = (),
    progress: Callable[[CheckResult], object] | None = None,
) -> list[CheckResult]:
    """Proves a device and its driver by known answers, as ``triad check`` does.

    level: "quick" (seconds), "standard" (about a minute) or "full". cases: ids like "C1"; none: all of the level.
    progress: called after each; False leaves the others out. Throws Error.
    """
    return _triad.check(str(device), level, list(cases), progress)


def set_verbosity(level: int) -> None:
    """What is said on standard error: 0 nothing, 1 warnings and what a user should know (at first), 2 more."""
    _triad.set_verbosity(level)
