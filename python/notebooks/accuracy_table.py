"""# A table of accuracy

Errors of float32, in the random number that would explain them (backward errors), for classes of quadrilaterals: near and far,
small and large, and cut by the horizon. The spacing of random numbers in float32 is 6e-8.
"""
import matplotlib.pyplot as plt
import numpy as np

import nusselt

# %% Lights: random quadrilaterals of a size at a distance
rng = np.random.default_rng(5)


def lights(size, distance, lowest, count=2000):
    """Quadrilaterals that face the shading point, nearly; the tangent of their elevation is at least `lowest`."""
    middle = rng.normal(size=(count, 3))
    middle[:, 2] = (lowest + (1 - lowest) * rng.random(count)) * np.linalg.norm(middle[:, :2], axis=-1)
    middle /= np.linalg.norm(middle, axis=-1, keepdims=True)
    square = np.array([[-1, -1, 0.3], [1, -1, 0.3], [1, 1, -0.3], [-1, 1, -0.3]])
    turned = nusselt.geometry.to_world(nusselt.geometry.frame(middle)[:, None], square)
    return (distance * middle[:, None] + 0.5 * size * turned).astype(np.float32)


classes = {"1 m at 1 m": lights(1, 1, 0.5), "1 m at 10 m": lights(1, 10, 0.1), "1 cm at 1 m": lights(0.01, 1, 0.5),
           "2 m at 1 m, cut by the horizon": lights(2, 1, -0.2)}
techniques = [nusselt.PolygonArea, nusselt.PolygonSolidAngle, nusselt.PolygonProjectedSolidAngle]

# %% Quantiles of the errors
figure, axes = plt.subplots(1, len(techniques), figsize=(11, 3.4), sharex=True, sharey=True, layout="constrained")
print(f"{'technique':28} {'lights':32} {'median':>9} {'99 %':>9} {'largest':>9}")
for axis, technique in zip(axes, techniques):
    for name, vertices in classes.items():
        u = rng.random((len(vertices), 2), np.float32)
        sample = technique(vertices).sample(u)
        error = nusselt.accuracy.backward_error(technique(vertices, dtype=np.float64), u, sample)
        error = np.sort(error[np.isfinite(error)])
        median, high = np.quantile(error, [0.5, 0.99])
        print(f"{technique.__name__:28} {name:32} {median:9.1e} {high:9.1e} {error[-1]:9.1e}")
        axis.loglog(np.maximum(error, 1e-9), 1 - np.arange(len(error)) / len(error), label=name)
    axis.set_title(technique.__name__, fontsize=9)
    axis.set_xlabel("backward error")
axes[0].set_ylabel("share of larger errors")
axes[0].legend(fontsize=7)
plt.show()
