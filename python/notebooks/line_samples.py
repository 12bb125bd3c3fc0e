"""# Line samples

Line samples take whole segments of a light, with exact visibility along them, in place of points. The room of the repository
with both kinds, against a rendering with many points. Lines cost more; what they are worth is the squared error times the time.
"""
import matplotlib.pyplot as plt
import numpy as np

import nusselt

# %% The scene, in a size for a glance
room = nusselt.load("scenes/room.pbrt")  # from the folder of the repository
room.apply_rig("scenes/rigs/room-panel.json")
room.resize(96, 54)

# %% Renderings
reference = nusselt.render(room, 512, pixel_position="center", seed=9)
images = {"16 points": nusselt.render(room, 16, pixel_position="center"),
          "16 lines": nusselt.render(room, 16, pixel_position="center", light_samples="lines", lines=16,
                                     many_occluders="lines"),
          "reference": reference}
figure, axes = plt.subplots(1, 3, figsize=(11, 2.5), layout="constrained")
white = np.quantile(reference.rgb, 0.9)
for axis, (name, image) in zip(axes, images.items()):
    axis.imshow(np.clip(image.rgb / white, 0, 1) ** (1 / 2.2))
    axis.set_title(f"{name}: RMSE {nusselt.rmse(image, reference):.4f}")
    axis.axis("off")
    seconds = image.statistics["render_seconds"]
    print(f"{name:10} {seconds:.2f} s, FLIP {nusselt.flip(image, reference).mean:.4f}, "
          f"squared error times time {1e6 * nusselt.rmse(image, reference)**2 * seconds:.2f}e-6 s")
plt.show()
