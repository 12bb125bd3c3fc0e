"""# Map of a technique

A technique maps the unit square to directions towards a light. Lines of equal random numbers show how: where they are close,
the density is high. Here a square light is seen from a point below its corner, and directions are projected onto the surface:
areas of this disk are projected solid angles. Samples of projected solid angle are therefore evenly spread in it.
"""
import matplotlib.pyplot as plt
import numpy as np

import nusselt

# %% The light, and three techniques for it
vertices = np.array([[-0.2, -0.2, 0.5], [1.2, -0.2, 0.5], [1.2, 1.2, 0.5], [-0.2, 1.2, 0.5]])
techniques = {"area": nusselt.PolygonArea(vertices), "solid angle": nusselt.PolygonSolidAngle(vertices),
              "projected solid angle": nusselt.PolygonProjectedSolidAngle(vertices)}

# %% Lines of equal random numbers, and Sobol' points
along = np.linspace(0, 1, 400, endpoint=False)
across = np.linspace(0, 1, 17)[:-1]
points = nusselt.random.points("sobol", 256, dtype=np.float64)
figure, axes = plt.subplots(1, 3, figsize=(10, 3.6), sharex=True, sharey=True, layout="constrained")
for axis, (name, technique) in zip(axes, techniques.items()):
    for first, colour in ((0, "tab:blue"), (1, "tab:orange")):
        u = np.empty((len(across), len(along), 2))
        u[..., first] = across[:, None]
        u[..., 1 - first] = along
        for line in technique.sample(u).wi:
            axis.plot(line[:, 0], line[:, 1], color=colour, linewidth=0.7)
    wi = technique.sample(points).wi
    axis.plot(wi[:, 0], wi[:, 1], "k.", markersize=2)
    axis.set_title(name)
    axis.set_aspect("equal")
plt.show()

# %% How even the points are: the spread of their density per projected solid angle
for name, technique in techniques.items():
    sample = technique.sample(points)
    density = sample.pdf / sample.wi[:, 2]
    print(f"{name:22} density per projected solid angle from {density.min():.3f} to {density.max():.3f} 1/sr")
