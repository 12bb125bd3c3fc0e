"""# Noise against samples

The irradiance of a point below a square light, half of which is hidden behind a disk, by three techniques and two kinds of
random numbers. The error falls like the square root of the number of samples for independent ones, faster for Sobol' points.
"""
import matplotlib.pyplot as plt
import numpy as np

import nusselt

# %% The light, and the disk that casts a shadow
vertices = np.array([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]) + [0.6, 0, 0]
techniques = {"area": nusselt.PolygonArea(vertices), "solid angle": nusselt.PolygonSolidAngle(vertices),
              "projected solid angle": nusselt.PolygonProjectedSolidAngle(vertices)}


def visible(wi):
    """Whether rays miss a disk of radius 0.4 at a height of 0.5."""
    at_disk = wi[..., :2] * (0.5 / wi[..., 2:])
    return np.linalg.norm(at_disk - [0.3, 0.1], axis=-1) > 0.4


def irradiance(technique, u):
    """Estimates for a radiance of 1, the mean over the last axis of samples."""
    wi, pdf, _ = technique.sample(u)
    return np.where(pdf > 0, visible(wi) * wi[..., 2] / pdf, 0).mean(axis=-1)


# %% The reference, and errors of 200 pixels
reference = irradiance(techniques["projected solid angle"], nusselt.random.points("sobol", 1 << 18, dtype=np.float64))
counts = 2 ** np.arange(0, 11)
figure, axis = plt.subplots(figsize=(6, 4), layout="constrained")
for sampler, style in (("independent", "--"), ("sobol", "-")):
    for (name, technique), colour in zip(techniques.items(), ("tab:blue", "tab:orange", "tab:green")):
        errors = []
        for count in counts:
            u = nusselt.random.light_random(sampler, np.arange(200)[:, None], 0, np.arange(count), int(count),
                                            dtype=np.float64)
            errors.append(np.sqrt(np.mean((irradiance(technique, u) - reference) ** 2)))
        axis.loglog(counts, errors, style, color=colour, label=f"{name}, {sampler}")
        slope = np.polyfit(np.log(counts[3:]), np.log(errors[3:]), 1)[0]
        print(f"{name:22} {sampler:12} error {errors[-1]:.2e} with {counts[-1]} samples, slope {slope:.2f}")
axis.set_xlabel("samples")
axis.set_ylabel("root mean square error of the irradiance [W/m^2]")
axis.legend(fontsize=8)
plt.show()
