"""Techniques over arrays: shapes, types, memory, threads and what the numbers mean."""
import copy
import pickle
import threading

import numpy as np
import pytest

import nusselt
from conftest import arguments_of
from nusselt.techniques import __all__ as TECHNIQUES


UP = [0, 0, 1.0]

# Largest errors in units of the precision of the type, about four times those that were measured for the lights of
# arguments_of() on all instruction sets.
UNIT_LENGTH = 4
DENSITY = 16
INVERSE = 64
POINT = 8
# At the rim of a cylinder, the density grows without bound and so does its error. Directions whose density is at most so
# many times the least one have errors of 530.
RIM = 20
DENSITY_BEFORE_RIM = 2000
# What the iteration that is left out of biased techniques would remove: 2.4e-6 here, of any type.
BIAS = 1e-5


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
    assert np.abs(np.linalg.norm(sample.wi, axis=-1) - 1).max() < UNIT_LENGTH * precision
    density = DENSITY
    if name == "CylinderArea":  # which also samples the side that is turned away
        density = DENSITY_BEFORE_RIM
        seen = (sample.pdf > 0) & (sample.pdf < RIM * sample.pdf[sample.pdf > 0].min())
        assert seen.mean() > 0.4
        sample, u = nusselt.Sample(*(array[seen] for array in sample)), u[seen]
    assert (sample.pdf > 0).all() and lights.measure() > 0
    assert np.abs(lights.pdf(sample.wi) / sample.pdf - 1).max() < density * precision
    assert np.abs(lights.invert(sample.wi) - u).max() < (BIAS if "Biased" in name else INVERSE * precision)
    along = sample.p / np.linalg.norm(sample.p, axis=-1, keepdims=True)
    assert np.abs(along - sample.wi).max() < POINT * precision


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


def test_outputs_must_be_apart(square, rng):
    lights = nusselt.PolygonArea(square)
    u = rng.random((10, 2))
    all_columns = np.zeros((10, 7))
    wi, pdf, p = lights.sample(u, out=[all_columns[:, :3], all_columns[:, 3], all_columns[::-1, 4:][::-1]])
    assert np.array_equal(all_columns, np.column_stack(lights.sample(u)))
    for out, message in [([wi, None, wi], "wi and p must not share memory"),
                         ([all_columns[:, 1:4], pdf, None], "wi and pdf must not share memory"),
                         ([None, np.lib.stride_tricks.as_strided(np.zeros(1), (10,), (0,)), None], "pdf must have each"),
                         ([np.lib.stride_tricks.as_strided(np.zeros(12), (10, 3), (8, 8)), None, None], "wi must have each"),
                         ([None, np.zeros(10, ">f8"), None], "pdf must be a float64 array"),
                         ([np.broadcast_to(np.zeros(3), (10, 3)), None, None], "wi must be writeable"),
                         ([None, None, np.zeros((10, 4), "V8")[:, 1:].view("f8")], None),
                         ([None, np.frombuffer(bytearray(81), np.uint8)[1:].view(np.float64), None], "pdf must be .*aligned")]:
        if message is None:
            lights.sample(u, out=out)
            continue
        with pytest.raises(ValueError, match=message):
            lights.sample(u, out=out)


def test_memory_of_inputs_is_free(square, rng):
    lights = nusselt.PolygonProjectedSolidAngle(square, dtype=np.float32)
    u = rng.random((33, 2)).astype(np.float32)
    expected = lights.sample(u)
    misaligned = np.frombuffer(bytearray(1) + u.tobytes(), np.uint8)[1:].view(np.float32).reshape(33, 2)
    assert not misaligned.flags.aligned
    for same in (u.astype(">f4"), misaligned, np.asfortranarray(u), u.astype(np.float64)):
        assert all(np.array_equal(a, b) for a, b in zip(lights.sample(same), expected))
    for wi in (expected.wi.astype(np.float64), expected.wi.astype(">f4")):
        pdf = lights.pdf(wi)
        assert pdf.dtype == np.float32 and np.array_equal(pdf, lights.pdf(expected.wi))
    big_endian = nusselt.PolygonProjectedSolidAngle(square.astype(">f4"))
    assert big_endian.dtype == np.dtype("=f4") and np.array_equal(big_endian.sample(u).wi, expected.wi)


def test_scalars_of_numpy_are_numbers(square):
    begin, end = square[:2]
    for radius in (0.5, np.float64(0.5), np.float32(0.5), np.array(0.5)):
        assert nusselt.CylinderArea(begin, end, radius).measure() == nusselt.CylinderArea(begin, end, 0.5).measure()
    assert nusselt.CylinderArea(begin.astype("f4"), end.astype("f4"), np.float64(0.5)).dtype == np.float32
    line = nusselt.LineArea(begin, end)
    assert np.array_equal(line.sample(np.float32(0.25)).wi, line.sample(0.25).wi)


def test_arrays_without_elements_have_results_without(square):
    nothing, directions = np.zeros((0, 4, 3)), np.zeros((3, 0, 3))
    lights = nusselt.PolygonArea(square)
    assert lights.pdf(directions).shape == (3, 0) and lights.invert(directions, threads=2).shape == (3, 0, 2)
    assert [array.shape for array in lights.sample(np.zeros((0, 2)))] == [(0, 3), (0,), (0, 3)]
    lobe = nusselt.LtcTable.frostbite().lobe(np.zeros(0), 1, 0.5)
    assert lobe.matrix.shape == (0, 5) and nusselt.ltc.density(lobe, UP).shape == (0,)
    assert nusselt.geometry.solid_angle(nothing).shape == nusselt.ltc.diffuse_integral(nothing).shape == (0,)
    assert nusselt.ltc.line_lobe_integral(directions, UP, nusselt.LtcTable.phong().lobe(0.5, 1, 1)).shape == (3, 0)
    assert nusselt.bsdf.lambert(directions, [1, 1, 1]).shape == (3, 0, 3)
    assert nusselt.bsdf.frostbite(UP, directions, [1, 1, 1], [1, 1, 1], 0.5).specular.shape == (3, 0, 3)
    assert nusselt.bsdf.ggx_sample(UP, 0.5, np.zeros((0, 2))).pdf.shape == (0,)
    assert nusselt.geometry.frame(directions).shape == (3, 0, 3, 3)
    assert nusselt.random.light_random("sobol", np.zeros(0, int), 0, 0, 4).shape == (0, 2)


def test_threads_share_an_object(square, rng):
    lights = nusselt.PolygonProjectedSolidAngle(square + 0.1 * rng.normal(size=(100, 1, 3)))
    u = [rng.random((200, 100, 2)) for _ in range(4)]
    expected = [lights.sample(numbers) for numbers in u]
    found = [None] * len(u)

    def work(i):
        for _ in range(5):
            found[i] = lights.sample(u[i], threads=2)
    threads = [threading.Thread(target=work, args=[i]) for i in range(len(u))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for ours, one in zip(found, expected):
        assert all(np.array_equal(a, b) for a, b in zip(ours, one))


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
            (TypeError, "at most 64 bits, not float128", lambda: nusselt.PolygonArea(square.astype(np.longdouble))),
            (TypeError, "radius must be real numbers of at most 64 bits, not <U1", lambda: nusselt.SphereSolidAngle([0, 0, 1], "a")),
            (TypeError, "u must be real numbers of at most 64 bits, not complex128", lambda: lights.sample([1j, 0])),
            (TypeError, "u must be .*, not float128", lambda: lights.sample(np.zeros(2, np.longdouble))),
            (TypeError, "wi must be real numbers .*, not <U", lambda: lights.pdf(["0", "0", "1"])),
            (TypeError, "wi must be .*, not object", lambda: lights.invert([None, 0, 1])),
            (TypeError, "threads must be a whole number, or None for all, not 2.7", lambda: lights.sample([0, 0], threads=2.7)),
            (ValueError, "threads must be .* below 2.31", lambda: lights.measure(threads=2**31)),
            (ValueError, r"u must have the shape \(\.\.\., 2\), not \(3,\)", lambda: lights.sample([0.1, 0.2, 0.3])),
            (ValueError, "broadcast", lambda: nusselt.LineArea(np.zeros((2, 3)), np.zeros((3, 3)))),
            (ValueError, "out: pdf must be a float32 array of the shape", lambda: lights.sample([0, 0], out=[None, np.empty(2), None])),
            (ValueError, "arrays for wi, pdf and p, not 2", lambda: lights.sample([0, 0], out=[None, None])),
            (TypeError, "out must be a list of arrays for wi, pdf and p, not int", lambda: lights.sample([0, 0], out=5)),
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


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda lights: pickle.loads(pickle.dumps(lights))])
def test_copies_have_the_same_bits(duplicate, square, rng):
    u = rng.random((7, 3, 2))
    for lights in (nusselt.PolygonArea(square + rng.random((3, 1, 3)), dtype=np.float32), make("CylinderArea")):
        other = duplicate(lights)
        assert (other.shape, other.dtype) == (lights.shape, lights.dtype)
        for ours, theirs in zip(other.sample(u), lights.sample(u)):
            assert np.array_equal(ours, theirs)


def test_what_arrays_were_made_for_stays(square):
    """With another shape, functions would read lights that are not there."""
    lights = nusselt.PolygonArea(np.stack([square, square]))
    for attribute, value in (("shape", (1000,)), ("dtype", np.dtype(np.float32))):
        with pytest.raises(AttributeError):
            setattr(lights, attribute, value)
