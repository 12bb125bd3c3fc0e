"""# A study of a light rig

How high should a lamp hang? A panel above the table of a room in the evening shines down, at three heights with the
same power: the higher it hangs, the more of the room it reaches, and the more even the light is.
"""
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np

import nusselt

# %% The room in the evening: a tenth of its own light
room = nusselt.load("scenes/room.pbrt")  # from the folder of the repository
room.edit([{"light": "*", "scale_radiance": 0.1}])
room.resize(320, 180)
(x0, y0, z0), (x1, y1, z1) = room.bounds
print("the room measures", np.round(np.subtract((x1, y1, z1), (x0, y0, z0)), 2), "m; up is y")

# %% One rendering for each height
heights = np.array([1.1, 1.6, 2.1])
pictures = []
for height in heights:
    study = room.copy()
    study.edit([{"add": "panel", "power": 45,
                 "panel": {"center": [(x0 + x1) / 2, y0 + height, (z0 + z1) / 2], "normal": [0, -1, 0],
                           "width": 0.6, "height": 0.6}}])
    pictures.append(nusselt.render(study, 16).rgb)
luminances = np.array(pictures) @ [0.2126, 0.7152, 0.0722]

# %% What one sees, and the luminance that a planner looks at
figure, axes = plt.subplots(2, len(heights), figsize=(13, 4.6), layout="constrained")
exposure = 0.25 / np.median(luminances)  # the same for all
for column, height, picture, luminance in zip(axes.T, heights, pictures, luminances):
    bright = exposure * picture
    column[0].imshow(np.clip(bright * (1 + bright / 16) / (1 + bright), 0, 1) ** (1 / 2.2))  # highlights fade to white
    column[0].set_title(f"a panel at {height:.1f} m")
    chart = column[1].imshow(np.maximum(luminance, 0.003), norm=matplotlib.colors.LogNorm(0.003, 3), cmap="inferno")
    for axis in column:
        axis.axis("off")
figure.colorbar(chart, ax=axes[1], label="radiance [W/(sr m$^2$)]")
plt.show()

# %% Brightness and contrast
for height, luminance in zip(heights, luminances):
    dark, middle, bright = np.quantile(luminance, [0.05, 0.5, 0.95])
    print(f"{height:.1f} m: median radiance {middle:.3f} W/(sr m^2), bright over dark parts {bright / dark:3.0f}")
