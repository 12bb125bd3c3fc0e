"""# A BRDF of your own with multiple importance sampling

A BRDF in ten lines of numpy, lit by a square light. Two techniques sample it: the solid angle of the light, and the lobe of the
BRDF. Each of them is bad for some surfaces; the balance heuristic combines them to an estimate that is good for all.
"""
import matplotlib.pyplot as plt
import numpy as np

import nusselt

# %% The BRDF: a lobe of Blinn's half vectors, normalised, and its sampling
wo = np.array([np.sin(0.7), 0, np.cos(0.7)])


def brdf(wi, exponent):
    half = (wi + wo) / np.linalg.norm(wi + wo, axis=-1, keepdims=True)
    return np.where(wi[..., 2] > 0, (exponent + 8) / (8 * np.pi) * np.maximum(half[..., 2], 0) ** exponent, 0)


def sample_brdf(u, exponent):
    cosine = u[..., 0] ** (1 / (exponent + 1))
    sine, angle = np.sqrt(1 - cosine**2), 2 * np.pi * u[..., 1]
    half = np.stack([sine * np.cos(angle), sine * np.sin(angle), cosine], axis=-1)
    return 2 * (half @ wo)[..., None] * half - wo


def brdf_density(wi, exponent):
    half = (wi + wo) / np.linalg.norm(wi + wo, axis=-1, keepdims=True)
    cosine = np.maximum((half * wo).sum(-1), 1e-9)
    return (exponent + 1) / (2 * np.pi) * np.maximum(half[..., 2], 0) ** exponent / (4 * cosine)


# %% The light. Where pdf() is 0, a direction misses it
vertices = np.array([[-2.0, -1, 1.5], [-0.5, -1, 1.5], [-0.5, 1, 1.5], [-2, 1, 1.5]])
light = nusselt.PolygonSolidAngle(vertices)


def hits(wi):
    """Whether directions hit the light: rays to its plane, between its sides."""
    at = wi * (1.5 / np.where(wi[..., 2:] > 0, wi[..., 2:], np.inf))
    low, high = vertices.min(0), vertices.max(0)
    return (wi[..., 2] > 0) & ((at[..., :2] > low[:2]) & (at[..., :2] < high[:2])).all(-1)


def ratio(value, density):
    """A contribution over its density, 0 where there is no sample."""
    return np.divide(value, density, out=np.zeros_like(value), where=density > 0)


# %% Variance of both techniques alone, and of their combination with half of the samples each
rng = np.random.default_rng(3)
u, v = rng.random((2, 50000, 2))
exponents = 2.0 ** np.arange(0, 15)
variances = {"light": [], "BRDF": [], "both": []}
for exponent in exponents:
    wi, pdf, _ = light.sample(u)
    other = brdf_density(wi, exponent)
    value = brdf(wi, exponent) * wi[:, 2]
    by_light, shared = ratio(value, pdf), ratio(value, pdf + other)
    wi = sample_brdf(v, exponent)
    density = brdf_density(wi, exponent)
    on_light = np.where(hits(wi), 1 / light.measure(), 0)
    value = brdf(wi, exponent) * np.maximum(wi[:, 2], 0) * (on_light > 0)
    by_brdf = ratio(value, density)
    combined = 2 * np.concatenate([shared, ratio(value, density + on_light)])
    means = [by_light.mean(), by_brdf.mean(), combined.mean()]
    spread = [by_light.std(), by_brdf.std(), combined.std()]
    for name, deviation in zip(variances, spread):
        variances[name].append(deviation / means[2])
    assert np.ptp(means) < 6 * max(spread) / np.sqrt(len(u)), "all three estimate the same"
figure, axis = plt.subplots(figsize=(6, 4), layout="constrained")
for name, values in variances.items():
    axis.loglog(exponents, values, label=name)
axis.set_xlabel("exponent of the BRDF")
axis.set_ylabel("relative standard deviation of a sample")
axis.legend()
plt.show()
print("worst relative deviation:", {name: round(float(max(values)), 2) for name, values in variances.items()})
