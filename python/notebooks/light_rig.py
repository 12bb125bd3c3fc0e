"""# A study of a light rig

How high should a lamp hang? A panel above the table of the room that shines down, at five heights with the same power: the
higher it hangs, the more of the room it reaches, and the more even the light is.
"""
import matplotlib.pyplot as plt
import numpy as np

import nusselt

# %% The room without its own lights
room = nusselt.load(SCENES / "room.pbrt")  # from run.py: the folder scenes of the repository
room.edit([{"light": "*", "enabled": False}])
room.resize(96, 54)
(x0, y0, z0), (x1, y1, z1) = room.bounds
print("the room measures", np.round(np.subtract((x1, y1, z1), (x0, y0, z0)), 2), "m; up is y")

# %% One rendering for each height
heights = np.linspace(0.45, 0.8, 5)
figure, axes = plt.subplots(1, len(heights), figsize=(13, 1.9), layout="constrained")
brightness, contrast = [], []
for axis, height in zip(axes, heights):
    study = room.copy()
    study.edit([{"add": "panel", "power": 60,
                 "panel": {"center": [(x0 + x1) / 2, y0 + height * (y1 - y0), (z0 + z1) / 2], "normal": [0, -1, 0],
                           "width": 0.6, "height": 0.6}}])
    picture = nusselt.render(study, 8).rgb
    luminance = picture @ [0.2126, 0.7152, 0.0722]
    brightness.append(np.median(luminance))
    contrast.append(np.quantile(luminance, 0.95) / np.median(luminance))
    axis.imshow(np.clip(10 * picture, 0, 1) ** (1 / 2.2))
    axis.set_title(f"{height * (y1 - y0):.2f} m")
    axis.axis("off")
plt.show()

# %% Brightness and contrast
for height, bright, ratio in zip(heights, brightness, contrast):
    print(f"{height * (y1 - y0):5.2f} m: median radiance {bright:7.3f} W/(sr m^2), bright parts {ratio:5.1f} times as bright")
