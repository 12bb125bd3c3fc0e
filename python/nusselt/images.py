"""Images of many layers, their files, and metrics for the difference between two images."""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple, Self

import numpy as np
import numpy.typing as npt

from nusselt import _arrays, _core
from nusselt._arrays import Array

__all__ = ["Flip", "Image", "compare", "flip", "hdr_flip", "merge", "psnr", "read", "rmse", "ssim", "write"]

Window = tuple[int, int, int, int]


class Image:
    """An image with its layers, as EXR files hold it."""

    #: For each layer its pixels: float32, (height, width, channels), row 0 on top. "" is the picture, linear RGB.
    layers: dict[str, Array]
    #: For each layer the names of its channels.
    channels: dict[str, list[str]]
    #: Settings of the rendering and the version of the program.
    metadata: dict[str, str]
    #: x, y, width and height of the pixels that are there, in those of the film.
    data_window: Window
    #: The whole film.
    display_window: Window

    _tiles = ""  # of a part, those that its file holds

    def __init__(self, layers: Mapping[str, npt.ArrayLike], channels: Mapping[str, Iterable[str]] | None = None,
                 metadata: Mapping[str, str] | None = None, data_window: Window | None = None,
                 display_window: Window | None = None,
                 foreign_metadata: Mapping[str, str] | None = None) -> None:
        """layers: arrays (height, width, channels) of one size. channels: their names where they are not R, G, B or Y."""
        self.layers = {name: _arrays.real_array(data, f"layer '{name}'", np.float32) for name, data in layers.items()}
        sizes = {data.shape[:2] for data in self.layers.values()}
        if len(sizes) != 1 or any(data.ndim != 3 for data in self.layers.values()):
            raise ValueError("layers must be arrays (height, width, channels) of one size")
        usual = {1: ["Y"], 3: ["R", "G", "B"], 4: ["R", "G", "B", "A"]}
        given = {} if channels is None else channels
        self.channels = {}
        for name, data in self.layers.items():
            count = data.shape[2]
            if name not in given and count not in usual:
                raise ValueError(f"layer '{name}' has {count} channels, whose names must be given")
            self.channels[name] = list(given[name]) if name in given else usual[count]
        self.metadata = dict(metadata or {})
        self.foreign_metadata = dict(foreign_metadata or {})
        height, width = next(iter(sizes))
        self.data_window = data_window or (0, 0, width, height)
        self.display_window = display_window or self.data_window

    @property
    def rgb(self) -> Array:
        """The picture: (height, width, 3) float32, linear RGB."""
        if "" not in self.layers:
            raise ValueError(f"the image has no picture, but the layers {', '.join(self.layers)}")
        return self.layers[""]

    def save(self, path: str | os.PathLike[str], *, exposure: float = 0) -> None:
        """Writes a file: .exr with all layers and metadata, of a part its tiles only; .png, .hdr and .pfm with the picture
        alone. exposure: stops by which PNG files are brightened."""
        name = _arrays.path_of(path)
        if _core.is_exr(name):
            _core.write_layers(name, self._parts())
        else:
            _core.write_image(name, _pixels(self), _texts(self.metadata, "metadata"), _arrays.finite(exposure, "exposure"))

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Image:
        """Reads all layers of an EXR file. Raises RuntimeError if it is none."""
        return Image._of(_core.read_layers(_arrays.path_of(path)))

    @classmethod
    def _of(cls, parts: tuple[Any, ...]) -> Self:
        layers, metadata, data_window, display_window, foreign, tiles = parts
        image = cls({name: data for name, _, data in layers}, {name: channels for name, channels, _ in layers},
                    metadata, data_window, display_window, foreign)
        image._tiles = tiles
        return image

    def _parts(self) -> tuple[Any, ...]:
        layers = []
        for name, data in self.layers.items():
            channels = [_arrays.text(channel, f"channels of layer '{name}'") for channel in self.channels.get(name, ())]
            layers.append((_arrays.text(name, "the name of a layer"), channels,
                           _arrays.real_array(data, f"layer '{name}'", np.float32)))
        return (layers, _texts(self.metadata, "metadata"), _window(self.data_window, "data_window"),
                _window(self.display_window, "display_window"), _texts(self.foreign_metadata, "foreign_metadata"),
                self._tiles)

    def __repr__(self) -> str:
        height, width = next(iter(self.layers.values())).shape[:2]
        names = ", ".join(name or "picture" for name in self.layers)
        return f"<nusselt.Image {width} x {height}: {names}>"


def merge(images: Mapping[str, Image], *, partial: bool = False) -> Image:
    """Joins parts or seeds of one rendering. images: by names for messages. Raises RuntimeError if they do not belong
    together, hold the same samples, or leave pixels without samples; partial allows the latter."""
    if not isinstance(images, Mapping) or not all(isinstance(image, Image) for image in images.values()):
        raise TypeError("images must be a dictionary of Images by their names")
    parts, missing = _core.merge([(_arrays.path_of(str(name)), image._parts()) for name, image in images.items()])
    if missing and not partial:
        raise RuntimeError(f"some pixels have no samples: {missing}; add what is missing, or use partial=True")
    return Image._of(parts)


def _texts(texts: Mapping[str, str], name: str) -> dict[str, str]:
    return {_arrays.text(key, f"a key of {name}"): _arrays.text(value, f"{name}[{key!r}]")
            for key, value in texts.items()}


def _window(window: Window, name: str) -> Window:
    if len(window) != 4:
        raise ValueError(f"{name} must be x, y, width and height, not {window}")
    x, y, width, height = (_arrays.whole_number(number, name) for number in window)
    return x, y, width, height


def read(path: str | os.PathLike[str]) -> Array:
    """Reads an image (height, width, 3) as float32, linear RGB: EXR, HDR, PFM, PNG, JPEG or TGA."""
    return _core.read_image(_arrays.path_of(path))


def write(path: str | os.PathLike[str], pixels: npt.ArrayLike, *, exposure: float = 0) -> None:
    """Writes an image (height, width, 3) of linear RGB as EXR, PNG, HDR or PFM. exposure: stops by which PNG files are
    brightened."""
    _core.write_image(_arrays.path_of(path), _pixels(pixels), {}, _arrays.finite(exposure, "exposure"))


class Flip(NamedTuple):
    """FLIP, an estimate of the differences that people see when they alternate between two images."""

    map: Array  #: (height, width) float64 in [0, 1]
    mean: float  #: over valid pixels


def compare(image: Image | npt.ArrayLike, reference: Image | npt.ArrayLike) -> dict[str, float]:
    """All differences to a reference: mse, rmse, relative_rmse, mae, rel_mse, mrse, both means, and the numbers of pixels
    that were compared and that are NaN or infinite."""
    return _core.compare(*_pair(image, reference))


def rmse(image: Image | npt.ArrayLike, reference: Image | npt.ArrayLike) -> float:
    """The root mean square error over all channels of all valid pixels."""
    return compare(image, reference)["rmse"]


def flip(image: Image | npt.ArrayLike, reference: Image | npt.ArrayLike, *,
         pixels_per_degree: float = _core.pixels_per_degree, exposure: float = 0) -> Flip:
    """FLIP of the images as a display shows them after `exposure` stops (Andersson et al. 2020)."""
    return Flip(*_core.flip(*_pair(image, reference), _pixel_density(pixels_per_degree),
                            _arrays.finite(exposure, "exposure")))


def hdr_flip(image: Image | npt.ArrayLike, reference: Image | npt.ArrayLike, *,
             pixels_per_degree: float = _core.pixels_per_degree) -> Flip:
    """The largest FLIP over the exposures at which the reference can be seen (Andersson et al. 2021)."""
    return Flip(*_core.hdr_flip(*_pair(image, reference), _pixel_density(pixels_per_degree)))


def psnr(image: Image | npt.ArrayLike, reference: Image | npt.ArrayLike, *, exposure: float = 0) -> float:
    """The peak signal to noise ratio of displayed values [dB]."""
    return _core.psnr(*_pair(image, reference), _arrays.finite(exposure, "exposure"))


def ssim(image: Image | npt.ArrayLike, reference: Image | npt.ArrayLike, *, exposure: float = 0) -> float:
    """The mean structural similarity of displayed values (Wang et al. 2004)."""
    return _core.ssim(*_pair(image, reference), _arrays.finite(exposure, "exposure"))


def _pixels(image: Image | npt.ArrayLike) -> Array:
    pixels = _arrays.real_array(image.rgb if isinstance(image, Image) else image, "pixels", np.float32)
    if pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.size == 0:
        raise ValueError(f"an image must have the shape (height, width, 3), not {pixels.shape}")
    return pixels


def _pair(image: Image | npt.ArrayLike, reference: Image | npt.ArrayLike) -> tuple[Array, Array]:
    pixels, others = _pixels(image), _pixels(reference)
    if pixels.shape != others.shape:
        raise ValueError(f"both images must have one size (height, width), not {pixels.shape[:2]} and {others.shape[:2]}")
    return pixels, others


def _pixel_density(pixels_per_degree: float) -> float:
    density = _arrays.finite(pixels_per_degree, "pixels_per_degree")
    if not 1 <= density <= 1000:
        raise ValueError(f"pixels_per_degree must lie between 1 and 1000, not {density}")
    return density
