"""Rendering of direct light to arrays."""
from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any

from nusselt import _arrays, _core
from nusselt.images import Image
from nusselt.scene import Scene

__all__ = ["Rendering", "render", "setting_names"]


class Rendering(Image):
    """An image that was rendered: float32 layers with the bits that `nusselt render` writes into EXR files."""

    #: Times [s] and numbers of rays.
    statistics: dict[str, Any]
    #: Share of the camera rays that are there; below 1 if the rendering was stopped.
    finished: float


def setting_names() -> dict[str, list[str]]:
    """The values of all settings of render() that are chosen by name. `nusselt render --help` explains them."""
    return _core.setting_names()


def render(scene: Scene, samples: int | None = None, *, technique: str | None = None,
           strategies: str | None = None, emission_sampling: str | None = None, mis: str | None = None,
           visibility_estimate: float | None = None, sampler: str | None = None,
           camera_rays: int | None = None, pixel_position: str | None = None, brdf: str | None = None,
           seed: int = 0, light_samples: str | None = None, lines: int | None = None,
           orientation: str | None = None, offsets: str | None = None, line_shading: str | None = None,
           many_occluders: str | None = None, layers: str | Sequence[str] = (),
           part: tuple[int, int] | None = None, resolution: tuple[int, int] | None = None,
           backend: str = "cpu", threads: int | None = None, isa: str | None = None,
           device: str | int | None = None, shadow_rays: str | None = None,
           progress: Callable[[float], object] | None = None) -> Rendering:
    """Renders the direct light of a scene.

    Settings are the options of `nusselt render` with the same names, values (setting_names()) and defaults: an option
    `--spp` is `samples`, `--pixel-center` is pixel_position="center". None stands for the default.

    samples: per pixel, light and technique; default: what the scene asks for, or 1.
    layers: names in a list or between commas, or "all"; the result has them beside the picture "".
    part: (number, count), to render the tiles of one part, in the whole image, which is black elsewhere; images.merge()
        joins parts.
    resolution: (width, height) in pixels in place of that of the scene.
    backend: "cpu"; "vulkan" for a GPU, with `device` (an index or a part of a name) and `shadow_rays`; or "auto", for a GPU
        if there is one that supports the scene with these settings, and the processor otherwise.
    threads: default: one per hardware thread. isa: instruction set; default: NUSSELT_ISA, or the best one.
    progress: called with the share of the work that is done, in this thread, about twenty times a second. If it returns
        False, or anything else that is false but None, the rendering stops, and the image has what is there.

    Ctrl-C, and exceptions of `progress`, stop the rendering and are raised. Wrong settings are ValueErrors.
    """
    settings = {"technique": technique, "strategies": strategies, "emission_sampling": emission_sampling,
                "mis": mis, "visibility_estimate": visibility_estimate, "sampler": sampler,
                "camera_rays": camera_rays, "pixel_position": pixel_position, "brdf": brdf, "seed": seed,
                "samples": samples, "light_samples": light_samples, "lines": lines, "orientation": orientation,
                "offsets": offsets, "line_shading": line_shading, "many_occluders": many_occluders,
                "layers": layers.split(",") if isinstance(layers, str) else layers, "part": part}
    if not isinstance(scene, Scene):
        raise TypeError(f"scene must be a Scene, which nusselt.load() makes of a file, not {scene!r}")
    if resolution is not None:
        try:
            width, height = resolution
        except (TypeError, ValueError):
            raise ValueError(f"resolution must be the pair (width, height), not {resolution!r}") from None
        scene = scene.copy()
        scene.resize(width, height)
    choice = _core.BackendChoice()
    choice.name = _arrays.text(backend, "backend")
    choice.threads = None if threads is None else _arrays.thread_count(threads)
    if isa is not None:
        choice.isa = _arrays.text(isa, "isa")
    if device is not None:
        choice.device = device if isinstance(device, str) else str(_arrays.whole_number(device, "device"))
    if shadow_rays is not None:
        choice.shadow_rays = _arrays.text(shadow_rays, "shadow_rays")
    parts, statistics, finished, notes = _core.render(scene._scene, settings, choice, progress)
    for note in notes:
        warnings.warn(note, stacklevel=2)
    image = Rendering._of(parts)
    image.statistics = statistics
    image.finished = finished
    return image
