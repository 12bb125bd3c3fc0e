"""Images in files and metrics, against numpy and against the command."""
import copy
import json
import os
import pickle
import subprocess

import numpy as np
import pytest

import nusselt
from nusselt import images


@pytest.fixture
def pair(rng):
    reference = rng.random((24, 32, 3)).astype(np.float32)
    return reference + rng.normal(scale=0.1, size=reference.shape).astype(np.float32), reference


@pytest.mark.parametrize("extension, tolerance", [("exr", 0), ("pfm", 0), ("hdr", 1 / 128), ("png", 1 / 128)])
def test_files_round_trip(extension, tolerance, pair, tmp_path):
    _, pixels = pair
    path = tmp_path / f"image.{extension}"
    images.write(path, pixels)
    assert np.abs(images.read(path) - pixels).max() <= tolerance


def test_images_of_many_layers_round_trip(rng, tmp_path):
    layers = {"": rng.random((5, 7, 3)), "depth": rng.random((5, 7, 1)), "motion": rng.random((5, 7, 2))}
    image = nusselt.Image(layers, {"depth": ["Z"], "motion": ["u", "v"]}, {"note": "by hand"},
                          data_window=(3, 4, 7, 5), display_window=(0, 0, 20, 10))
    image.save(tmp_path / "image.exr")
    read = nusselt.Image.load(tmp_path / "image.exr")
    for name in layers:
        assert np.array_equal(read.layers[name], image.layers[name]) and read.channels[name] == image.channels[name]
    assert read.metadata == image.metadata
    assert (read.data_window, read.display_window) == ((3, 4, 7, 5), (0, 0, 20, 10))


def test_metrics_agree_with_numpy_and_the_command(pair, program, tmp_path):
    image, reference = pair
    difference = (image - reference).astype(np.float64)
    metrics = images.compare(image, reference)
    assert np.isclose(nusselt.rmse(image, reference), np.sqrt((difference**2).mean()), rtol=1e-6)
    assert np.isclose(metrics["mae"], np.abs(difference).mean(), rtol=1e-6)
    images.write(tmp_path / "a.exr", image)
    images.write(tmp_path / "b.exr", reference)
    text = subprocess.run([os.environ["NUSSELT_PROGRAM"], "compare", tmp_path / "a.exr", tmp_path / "b.exr", "--metrics", "all",
                           "--json", "-"], check=True, capture_output=True, text=True).stdout
    (report,) = json.loads(text)["images"]
    ours = {**{key: metrics[key] for key in ("mse", "rmse", "relative_rmse", "mae", "rel_mse", "mrse", "compared_pixels")},
            "mean_image": metrics["mean"], "mean_reference": metrics["mean_of_reference"],
            "flip": nusselt.flip(image, reference).mean, "hdr_flip": images.hdr_flip(image, reference).mean,
            "ssim": images.ssim(image, reference), "psnr": images.psnr(image, reference)}
    assert ours == {key: report[key] for key in ours}
    assert len(set(ours.values())) == len(ours), "equal numbers could be swapped"


def test_flip_maps_show_where_images_differ(pair):
    _, reference = pair
    changed = reference.copy()
    changed[10:14, 10:14] = 0
    result = nusselt.flip(changed, reference)
    assert result.map.shape == (24, 32) and 0 < result.mean < 1
    assert result.map[12, 12] > 5 * result.map[23, 31]
    assert nusselt.flip(reference, reference).mean == 0


def test_wrong_images_are_errors(pair, tmp_path):
    image, reference = pair
    pixels = reference
    for metric in (nusselt.rmse, nusselt.flip, images.hdr_flip, images.psnr, images.ssim):
        with pytest.raises(ValueError, match=r"one size \(height, width\), not \(24, 16\) and \(24, 32\)"):
            metric(image[:, :16], reference)
        with pytest.raises(TypeError, match="pixels must be real numbers, not complex"):
            metric(image * 1j, reference)
    for options, message in [({"pixels_per_degree": 0}, "between 1 and 1000, not 0"),
                             ({"pixels_per_degree": 1e9}, "between 1 and 1000"),
                             ({"exposure": np.nan}, "exposure must be finite"),
                             ({"exposure": np.inf}, "exposure must be finite")]:
        with pytest.raises(ValueError, match=message):
            nusselt.flip(image, reference, **options)
    with pytest.raises(ValueError, match=r"\(height, width, 3\), not \(24, 32\)"):
        nusselt.rmse(image[..., 0], reference)
    layered = nusselt.Image({"": pixels[:, :8], "depth": pixels[:, :8, :1]}, metadata={"samples": "1"})
    for attribute, value, message in [
            ("data_window", (0, 0, 9999, 9999), r"layer '' must have the shape \(9999, 9999, 3\) .*, not \(24, 8, 3\)"),
            ("layers", {"": pixels[:, :8], "depth": pixels[:2]}, r"layer 'depth' must have the shape \(24, 8, 1\)"),
            ("layers", {"": pixels[0, :8]}, r"layer '' .*, not \(8, 3\)"),
            ("channels", {"": ["R", "G"], "depth": ["Z"]}, r"shape \(24, 8, 2\)"),
            ("layers", {}, "an image must have a layer"),
            ("data_window", (0, 0, 8), "data_window must be x, y, width and height"),
            ("data_window", (0, 0, 8, 2**31), "data_window must be below 2.31")]:
        wrong = copy.copy(layered)
        setattr(wrong, attribute, value)
        with pytest.raises(ValueError, match=message):
            images.merge({"wrong": wrong})
        with pytest.raises(ValueError, match=message):
            wrong.save(tmp_path / "wrong.exr")
    for attribute, value, message in [
            ("data_window", (0, 0, 8.5, 24), "data_window must be a whole number, not 8.5"),
            ("metadata", {"samples": 1}, r"metadata\['samples'\] must be a text, not 1"),
            ("channels", {"": ["R", "G", 3], "depth": ["Z"]}, "channels of layer '' must be a text, not 3"),
            ("layers", {"": pixels[:, :8] * 1j, "depth": pixels[:, :8, :1]}, "layer '' must be real numbers, not complex")]:
        wrong = copy.copy(layered)
        setattr(wrong, attribute, value)
        with pytest.raises(TypeError, match=message):
            wrong.save(tmp_path / "wrong.exr")
    for extension in ("png", "hdr"):
        with pytest.raises(ValueError, match=r"\(height, width, 3\), not \(24, 8, 1\)"):
            nusselt.Image({"": pixels[:, :8, :1]}).save(tmp_path / f"grey.{extension}")
        with pytest.raises(ValueError, match="no picture, but the layers depth"):
            nusselt.Image({"depth": pixels[:, :8, :1]}).save(tmp_path / f"depth.{extension}")
    for wrong in ([layered], {"a": pixels}):
        with pytest.raises(TypeError, match="images must be a dictionary of Images"):
            images.merge(wrong)
    with pytest.raises(ValueError, match="must not have zeros"):
        nusselt.Image.load(f"{tmp_path}/image.exr\0")
    with pytest.raises(RuntimeError, match="missing.exr"):
        nusselt.Image.load(tmp_path / "missing.exr")
    with pytest.raises(RuntimeError, match="image.gif"):
        images.write(tmp_path / "image.gif", image)
    with pytest.raises(ValueError, match="one size"):
        nusselt.Image({"": image, "small": image[:5]})


def test_files_need_not_be_in_unicode(pair, tmp_path):
    """Neither their names nor the texts in them: those of other programs may be in any encoding."""
    _, pixels = pair
    name = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.exr")
    image = nusselt.Image({"": pixels, os.fsdecode(b"\xfe"): pixels}, metadata={"owner": os.fsdecode(b"J\xfcrgen")})
    image.save(name)
    read = nusselt.Image.load(name)
    assert read.metadata == image.metadata and set(read.layers) == set(image.layers)
    assert np.array_equal(images.read(name), pixels)
    with pytest.raises(RuntimeError, match=r"cannot read '.*\\xfd.exr'"):
        images.read(os.fsdecode(os.fsencode(tmp_path) + b"/\xfd.exr"))


def test_images_can_be_pickled(pair):
    _, pixels = pair
    image = pickle.loads(pickle.dumps(nusselt.Image({"": pixels}, metadata={"a": "b"})))
    assert np.array_equal(image.rgb, pixels) and image.metadata == {"a": "b"}
