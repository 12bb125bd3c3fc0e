"""BRDFs, lobes, closed forms, frames and random numbers, against formulas and integrals in numpy."""
import numpy as np
import pytest

import nusselt
from nusselt import bsdf, geometry, ltc

UP = np.array([0, 0, 1.0])


def directions(rng, *shape):
    """Unit vectors above the surface."""
    v = rng.normal(size=shape + (3,))
    v[..., 2] = np.abs(v[..., 2])
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def test_lambert_is_albedo_over_pi(rng):
    value = bsdf.lambert(directions(rng, 5), [0.2, 0.5, 0.8])
    assert np.allclose(value, np.array([0.2, 0.5, 0.8]) / np.pi)
    assert not bsdf.lambert([0, 0, -1.0], [1, 1, 1]).any()


def test_frostbite_agrees_with_its_formula(rng):
    wo, wi = directions(rng, 100), directions(rng, 100)
    roughness = rng.uniform(0.2, 1, 100)
    albedo, f0 = rng.random((100, 3)), rng.random((100, 3))
    value = bsdf.frostbite(wo, wi, albedo, f0, roughness)
    half = (wo + wi) / np.linalg.norm(wo + wi, axis=-1, keepdims=True)
    a2 = roughness**4
    cos_h = (half * wi).sum(-1)
    d = a2 / np.pi / (half[:, 2]**2 * (a2 - 1) + 1)**2
    def slant(cosine):
        return np.sqrt(cosine**2 * (1 - a2) + a2)
    v = 0.5 / (wi[:, 2] * slant(wo[:, 2]) + wo[:, 2] * slant(wi[:, 2]))
    fresnel = f0 + (1 - f0) * (1 - cos_h[:, None])**5
    assert np.allclose(value.specular, (d * v)[:, None] * fresnel, rtol=1e-9)
    f90 = roughness / 2 + 2 * roughness * cos_h**2
    scatter = (1 + (f90 - 1) * (1 - wi[:, 2])**5) * (1 + (f90 - 1) * (1 - wo[:, 2])**5)
    energy = 1 - roughness * (1 - 1 / 1.51)
    assert np.allclose(value.diffuse, albedo * (energy * scatter / np.pi)[:, None], rtol=1e-9)


def test_phong_is_a_power_of_the_cosine(rng):
    wo, wi = directions(rng, 100), directions(rng, 100)
    cosine = np.maximum((wi * wo * [-1, -1, 1]).sum(-1), 0)
    assert np.allclose(bsdf.phong(wo, wi, [1, 1, 1], 7)[:, 0], 9 / (2 * np.pi) * cosine**7, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("bounded", [False, True])
def test_visible_normals_follow_their_density(bounded, rng):
    wo = np.array([0.6, 0, 0.8])
    u = rng.random((200000, 2))
    sample = bsdf.ggx_sample(wo, 0.6, u, bounded=bounded)
    assert np.abs(bsdf.ggx_pdf(wo, 0.6, sample.wi, bounded=bounded) / sample.pdf - 1).max() < 1e-6
    assert np.abs(bsdf.ggx_invert(wo, 0.6, sample.wi, bounded=bounded) - u).max() < 1e-6
    sky = directions(rng, 200000)
    above = 2 * np.pi * bsdf.ggx_pdf(wo, 0.6, sky, bounded=bounded)
    share = (sample.wi[:, 2] > 0).mean()
    error = np.hypot(above.std(), 1) / np.sqrt(len(sky))
    assert abs(above.mean() - share) < 5 * error
    assert abs(bsdf.ggx_pdf(wo, 0.5, sky, bounded=bounded).mean() * 2 * np.pi - share) > 0.1 * error


def test_closed_forms_agree_with_samples(square, rng):
    lobe = nusselt.LtcTable.frostbite().lobe(0.4, 0.6, 0.04)
    assert np.isclose(ltc.lobe_integral(square, lobe), nusselt.PolygonLtc(square, lobe).measure(), rtol=1e-9)
    assert np.isclose(geometry.projected_solid_angle(square), nusselt.PolygonProjectedSolidAngle(square).measure())
    assert np.isclose(geometry.solid_angle(square), 2 * np.pi / 3)
    assert np.isclose(ltc.diffuse_integral(square) * np.pi, geometry.projected_solid_angle(square))
    begin, end = [-1, 0, 1.0], [1, 0.5, 1.5]
    assert np.isclose(ltc.line_diffuse_integral(begin, end) * np.pi,
                      nusselt.LineProjectedSolidAngle(begin, end).measure())
    assert np.isclose(ltc.line_lobe_integral(begin, end, lobe), nusselt.LineLtc(begin, end, lobe).measure())
    hexagon = np.stack([[np.cos(t), np.sin(t), 1] for t in np.arange(6) * np.pi / 3])
    sample = nusselt.PolygonArea(hexagon).sample(rng.random((100000, 2)))
    assert abs((1 / sample.pdf).mean() / geometry.solid_angle(hexagon) - 1) < 0.01
    density = ltc.density(lobe, sample.wi)
    assert abs((density / sample.pdf).mean() / ltc.lobe_integral(hexagon, lobe) - 1) < 0.02


@pytest.mark.parametrize("center", [[0.4, 0.2, 1.5], [-0.9, 0.4, 0.1], [0.2, 0.1, 0.1]], ids=["above", "cut", "around"])
def test_measures_of_round_lights_are_integrals(center, rng):
    radius, axes = 0.5, [[0.5, 0.1, 0], [-0.1, 0.4, 0.2], [0, -0.2, 0.6]]
    lobe = nusselt.LtcTable.frostbite().lobe(0.6, 0.6, 0.04)
    lights = {"Sphere": [center, radius], "Disk": [center, [0, 0.6, 0.8], radius], "Ellipse": [center, axes[0], axes[1]],
              "Ellipsoid": [center, axes]}
    for name, light in lights.items():
        def measure(technique, *more):
            return getattr(nusselt, name + technique)(*light, *more).measure()
        sample = getattr(nusselt, f"{name}SolidAngle")(*light).sample(rng.random((400000, 2)))
        above, density = sample.wi[:, 2] > 0, ltc.density(lobe, sample.wi)
        for integral, expected in [(above * sample.wi[:, 2], measure("ProjectedSolidAngle")),
                                   (density, measure("Ltc", lobe)), (above * density, measure("ClippedLtc", lobe))]:
            terms = integral / sample.pdf
            assert abs(terms.mean() - expected) < 5 * terms.std() / np.sqrt(len(terms)), (name, expected)
            assert abs(terms.mean() - 1.02 * expected) > 5 * terms.std() / np.sqrt(len(terms))


def test_tables_are_those_of_the_library():
    table = nusselt.LtcTable.frostbite()
    assert table.entries.ndim == 4 and table.entries.shape[3] == 6 and not table.entries.flags.writeable
    lobe = table.lobe(np.linspace(0, 1, 7), [[0.1], [1.0]], 0.5, dtype=np.float32)
    assert lobe.matrix.shape == (2, 7, 5) and lobe.albedo.dtype == np.float32
    corner = table.lobe(1, 1, 1)
    expected = table.entries[-1, 0, -1].astype(float)
    assert np.allclose(corner.matrix * [1, 1, 0, -1, 1], expected[[0, 1, 2, 3, 4]] * [1, 1, 0, 1, 1])
    assert np.isclose(corner.matrix[2], 1 / expected[2]) and np.isclose(corner.albedo, expected[5])
    assert not np.allclose(nusselt.LtcTable.phong().entries[5, 5], table.entries[5, 5, :1])


def test_a_file_that_is_no_table_is_an_error(tmp_path):
    with pytest.raises(RuntimeError, match=f"{tmp_path}: cannot be read"):
        ltc.LtcTable.load(tmp_path)
    path = tmp_path / "table.bin"
    path.write_bytes(b"no table")
    with pytest.raises(RuntimeError, match="table.bin"):
        nusselt.LtcTable.load(path)
    with pytest.raises(TypeError, match=r"use LtcTable.frostbite\(\), LtcTable.phong\(\) or LtcTable.load"):
        nusselt.LtcTable(str(path))


def test_frames_turn_the_normal_to_z(rng):
    normal, wo = directions(rng, 50), directions(rng, 50)
    for frames in (geometry.frame(normal), geometry.shading_frame(normal, wo)):
        assert np.allclose(np.einsum("nij,nkj->nik", frames, frames), np.eye(3), atol=1e-12)
        assert np.allclose(np.linalg.det(frames), 1)
        assert np.allclose(geometry.to_shading(frames, normal), UP)
        assert np.allclose(geometry.to_world(frames, geometry.to_shading(frames, wo)), wo)
    local = geometry.to_shading(geometry.shading_frame(normal, wo), wo)
    assert np.abs(local[:, 1]).max() < 1e-12 and (local[:, 0] >= 0).all()


def test_float32_arguments_give_float32(square):
    assert geometry.solid_angle(square.astype(np.float32)).dtype == np.float32
    wi = np.array([[0, 0, 1]], np.float32)
    assert bsdf.lambert(wi, np.float32([0.5, 0.5, 0.5])).dtype == np.float32
    assert bsdf.phong(wi, wi, np.float32([1, 1, 1]), 3).dtype == np.float32


@pytest.mark.parametrize("sampler", nusselt.setting_names()["sampler"])
def test_points_are_stratified_as_their_sampler_says(sampler):
    u = nusselt.random.points(sampler, 64, seed=3, dtype=np.float64)
    assert u.shape == (64, 2) and (u >= 0).all() and (u < 1).all()
    strata = len(set((64 * u[:, 0]).astype(int)))
    assert strata == 64 if sampler != "independent" else strata < 60
    assert not np.array_equal(u, nusselt.random.points(sampler, 64, seed=4, dtype=np.float64))
    image = nusselt.random.light_random(sampler, np.arange(8), np.arange(5)[:, None], 3, 64, seed=3)
    assert image.shape == (5, 8, 2) and image.dtype == np.float32
    assert np.allclose(image[0, 0], u[3], atol=1e-7)


def test_wrong_names_and_numbers_of_random_points_are_errors():
    with pytest.raises(ValueError, match="unknown setting 'halton'; use one of independent, sobol"):
        nusselt.random.points("halton", 4)
    with pytest.raises(ValueError, match="sample must be whole numbers"):
        nusselt.random.light_random("sobol", 0, 0, -1, 4)
    for error, message, call in [
            (TypeError, "sampler must be a text, not None", lambda: nusselt.random.points(None, 4)),
            (ValueError, "count must be whole numbers", lambda: nusselt.random.points("sobol", 4.0)),
            (ValueError, r"pixel must be the pair \(x, y\), not 3", lambda: nusselt.random.points("sobol", 4, pixel=3)),
            (ValueError, r"pixel must be the pair", lambda: nusselt.random.points("sobol", 4, pixel=(1, 2, 3))),
            (TypeError, "dtype must be float32 or float64, not None", lambda: nusselt.random.points("sobol", 4, dtype=None))]:
        with pytest.raises(error, match=message):
            call()
    for message, options in [("seed must be whole numbers from 0 to 2.32 - 1", {"seed": -1}),
                             ("light must be whole numbers", {"light": 2**40}),
                             ("pair must be whole numbers", {"pair": 0.5}),
                             (r"seed must be one whole number, not an array \(2,\)", {"seed": [1, 2]})]:
        with pytest.raises(ValueError, match=message):
            nusselt.random.points("sobol", 4, **options)
    with pytest.raises(ValueError, match="sample must be below sample_count, which is 4"):
        nusselt.random.light_random("stratified", 0, 0, [0, 4], 4)
    for sampler, most in [("jittered", 2**22), ("z_sobol", 2**31)]:
        assert nusselt.random.light_random(sampler, 0, 0, most - 1, most).shape == (2,)
        for count in (0, most + 1):
            with pytest.raises(ValueError, match=f"sample_count must lie between 1 and .* for sampler '{sampler}', not {count}"):
                nusselt.random.light_random(sampler, 0, 0, 0, count)


def test_wrong_frames_and_vectors_are_errors():
    for turn in (geometry.to_shading, geometry.to_world):
        for error, message, arguments in [
                (ValueError, r"frames must have the shape \(..., 3, 3\), not \(3, 2\)", (np.ones((3, 2)), [1, 2, 3])),
                (ValueError, r"v must have the shape \(..., 3\), not \(2,\)", (np.eye(3), [1, 2])),
                (TypeError, "complex", (np.eye(3) * 1j, [1, 2, 3]))]:
            with pytest.raises(error, match=message):
                turn(*arguments)
    assert geometry.to_world(np.eye(3, dtype=np.float32), np.ones(3, np.float32)).dtype == np.float32
