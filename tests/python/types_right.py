"""A program whose types are right."""
import numpy as np

import nusselt

light = nusselt.LineSolidAngle([0, 0, 1], np.ones(3), dtype=np.float32)
sample: nusselt.Sample = light.sample(0.5, threads=None)
lobe = nusselt.LtcTable.frostbite().lobe(0.5, 1, 0.04)
glossy = nusselt.PolygonLtc(np.ones((4, 3)), lobe)
area: float = glossy.measure()
scene = nusselt.load("room.pbrt")
scene.edit([{"light": "lamp", "power": 60}])
image = nusselt.render(scene, 4, technique="area", layers=["albedo"], part=(1, 2), progress=print)
names: dict[str, list[str]] = nusselt.setting_names()
image.save("room.exr")
difference: float = nusselt.rmse(image, nusselt.Image.load("other.exr"))
