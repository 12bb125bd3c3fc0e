"""Techniques over arrays: shapes, types, memory, threads and what the numbers mean."""
import numpy as np
import pytest

import nusselt
from conftest import arguments_of
from nusselt.techniques import __all__ as TECHNIQUES


def make(name, **options):
    return getattr(nusselt, name)(*arguments_of(name), **options)


def random_numbers(technique, rng, *shape):
    return rng.random(shape + technique._random)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("name", TECHNIQUES)
def test_samples_densities_and_inverses_agree(name, dtype, rng):
    lights = make(name, dtype=dtype)
    u = random_numbers(lights, rng, 1000)
    sample = lights.sample(u)
    assert sample.wi.dtype == sample.pdf.dtype == sample.p.dtype == dtype
    assert sample.wi.shape == sample.p.shape == (1000, 3) and sample.pdf.shape == (1000,)
    precision = np.finfo(dtype).eps
    assert np.abs(np.linalg.norm(sample.wi, axis=-1) - 1).max() < 4 * precision
    if name == "CylinderArea":  # which also samples the side that is turned away; directions near its rim tell little
        seen = (sample.pdf > 0) & (sample.pdf < 20 * sample.pdf[sample.pdf > 0].min())
        assert seen.mean() > 0.4
        sample, u = nusselt.Sample(*(array[seen] for array in sample)), u[seen]
    assert (sample.pdf > 0).all() and lights.measure() > 0
    assert np.abs(lights.pdf(sample.wi) / sample.pdf - 1).max() < 1e4 * precision
    biased = "Biased" in name
    assert np.abs(lights.invert(sample.wi) - u).max() < (0.02 if biased else 1e4 * precision)
    along = sample.p / np.linalg.norm(sample.p, axis=-1, keepdims=True)
    assert np.abs(along - sample.wi).max() < 100 * precision


@pytest.mark.parametrize("name", TECHNIQUES)
def test_an_array_of_lights_has_the_bits_of_single_lights(name, rng):
    parts = arguments_of(name)
    shifted = [parts[0] + 0.2 * rng.normal(size=(3, 50) + (1,) * parts[0].ndim), *parts[1:]]
    lights = getattr(nusselt, name)(*shifted)
    assert lights.shape == (3, 50)
    u = random_numbers(lights, rng, 2, 3, 50)
    sample = lights.sample(u)
    for i, j in [(0, 0), (1, 17), (2, 49)]:
        alone = getattr(nusselt, name)(shifted[0][i, j], *parts[1:])
        one = alone.sample(u[:, i, j])
        for ours, single in zip(sample, one):
            assert np.array_equal(ours[:, i, j], single)
        assert np.array_equal(lights.pdf(sample.wi)[:, i, j], alone.pdf(one.wi))
        assert np.array_equal(lights.invert(sample.wi)[:, i, j], alone.invert(one.wi))
        assert lights.measure()[i, j] == alone.measure()


def test_few_lights_with_many_samples_have_the_bits_of_many_lights(square, rng):
    few = nusselt.PolygonSolidAngle(square + 0.1 * rng.normal(size=(3, 1, 3)))
    u = rng.random((1000, 3, 2))
    many = few.sample(u[:1])
    assert np.array_equal(few.sample(u).wi[0], many.wi[0])


def test_shapes_broadcast(square, rng):
    begin, end = rng.normal(size=(4, 1, 3)), rng.normal(size=(5, 3))
    lights = nusselt.LineArea(begin, end)
    assert lights.shape == (4, 5) and lights.measure().shape == (4, 5)
    u = rng.random((3, 1, 1))
    sample = lights.sample(u)
    assert sample.wi.shape == (3, 4, 5, 3)
    assert np.array_equal(sample.wi[:, 2, 3], nusselt.LineArea(begin[2, 0], end[3]).sample(u[:, 0, 0]).wi)
    assert lights.sample(0.5).pdf.shape == (4, 5)
    single = nusselt.PolygonArea(square)
    assert single.sample([0.25, 0.5]).wi.shape == (3,) and np.ndim(single.sample([0.25, 0.5]).pdf) == 0
    assert np.ndim(single.measure()) == 0 and single.measure() == 4
    assert single.sample(np.empty((0, 2))).wi.shape == (0, 3)


@pytest.mark.parametrize("count", [1, 15, 16, 255, 256, 257, 1000])
def test_all_memory_layouts_and_thread_counts_have_the_same_bits(count, square, rng):
    lights = nusselt.PolygonProjectedSolidAngle(square, dtype=np.float32)
    u = rng.random((count, 2)).astype(np.float32)
    expected = lights.sample(u)
    columns = np.empty((2, count), np.float32).T
    columns[...] = u
    assert np.array_equal(lights.sample(columns).wi, expected.wi)
    reversed_ = lights.sample(u[::-1]).wi[::-1]
    assert np.array_equal(reversed_, expected.wi)
    wide = np.zeros((count, 7), np.float32)
    wide[:, 2:4] = u
    assert np.array_equal(lights.sample(wide[:, 2:4]).p, expected.p)
    outputs = [np.empty((3, count), np.float32).T, np.empty(2 * count, np.float32)[::2],
               np.empty((count, 5), np.float32)[:, 1:4]]
    given = lights.sample(u, out=outputs, threads=2)
    assert all(a is b for a, b in zip(given, outputs))
    assert all(np.array_equal(a, b) for a, b in zip(given, expected))
    grid = lights.sample(np.broadcast_to(u, (3, count, 2)), threads=None)
    assert all(np.array_equal(grid.wi[i], expected.wi) for i in range(3))


def test_outputs_may_be_inputs(square, rng):
    lights = nusselt.PolygonArea(square)
    wi = lights.sample(rng.random((1000, 2))).wi
    expected = lights.invert(wi)
    assert np.array_equal(lights.invert(wi, out=wi[:, :2]), expected)


def test_types_follow_numpy(square):
    single = square.astype(np.float32)
    assert nusselt.PolygonArea(square).dtype == np.float64
    assert nusselt.PolygonArea(square.tolist()).dtype == np.float64
    assert nusselt.PolygonArea(single).dtype == np.float32
    assert nusselt.PolygonArea(square, dtype="f4").dtype == np.float32
    assert nusselt.CylinderArea(single[0], single[1], 0.5).dtype == np.float32


def test_random_numbers_stay_below_one_in_float32(square):
    lights = nusselt.PolygonArea(square, dtype=np.float32)
    below = np.float64(1) - 2.0**-50
    assert np.float32(below) == 1
    assert np.array_equal(lights.sample([below, below]).p, lights.sample([np.nextafter(np.float32(1), np.float32(0))] * 2).p)


def test_wrong_arguments_are_errors(square):
    lights = nusselt.PolygonArea(square, dtype=np.float32)
    for error, message, call in [
            (ValueError, r"n = 3 to 8, not \(9, 3\)", lambda: nusselt.PolygonArea(np.zeros((9, 3)))),
            (ValueError, r"n = 3 to 7, not \(8, 3\)", lambda: nusselt.PolygonClippedLtc(np.zeros((8, 3)), np.zeros(5))),
            (ValueError, r"n = 4, not \(3, 3\)", lambda: nusselt.RectangleSolidAngle(square[:3])),
            (ValueError, r"lobe must have the shape \(\.\.\., 5\), not \(4,\)", lambda: nusselt.PolygonLtc(square, np.zeros(4))),
            (ValueError, "there are no lights", lambda: nusselt.PolygonArea(np.zeros((0, 4, 3)))),
            (TypeError, "float16", lambda: nusselt.PolygonArea(square, dtype=np.float16)),
            (TypeError, "complex", lambda: nusselt.PolygonArea(square * 1j)),
            (ValueError, r"u must have the shape \(\.\.\., 2\), not \(3,\)", lambda: lights.sample([0.1, 0.2, 0.3])),
            (ValueError, "broadcast", lambda: nusselt.LineArea(np.zeros((2, 3)), np.zeros((3, 3)))),
            (ValueError, "out: pdf must be a float32 array of the shape", lambda: lights.sample([0, 0], out=[None, np.empty(2), None])),
            (ValueError, "arrays for wi, pdf and p, not 2", lambda: lights.sample([0, 0], out=[None, None])),
            (ValueError, "threads must be at least 1", lambda: lights.sample([0, 0], threads=0))]:
        with pytest.raises(error, match=message):
            call()


def test_nothing_below_the_horizon_is_no_sample(square):
    below = nusselt.PolygonProjectedSolidAngle(-square - [0, 0, 1])
    assert below.measure() == 0 and below.sample([0.5, 0.5]).pdf == 0


def test_errors_of_float32_are_small(square, rng):
    u = rng.random((10000, 2)).astype(np.float32)
    exact = nusselt.PolygonProjectedSolidAngle(square.astype(np.float32), dtype=np.float64)
    sample = nusselt.PolygonProjectedSolidAngle(square, dtype=np.float32).sample(u)
    error = nusselt.accuracy.backward_error(exact, u, sample)
    assert 1e-9 < np.median(error) and error.max() < 1e-5
    turned = nusselt.accuracy.backward_error(exact, u + 1e-3, sample)
    assert np.median(turned) > 9e-4, "a wrong random number must be noticed"
    assert nusselt.accuracy.density_error(exact, sample).max() < 1e-5
