"""A program in which each marked line has a wrong type."""
import nusselt

nusselt.LineSolidAngle([0, 0, 1])  # wrong
nusselt.PolygonArea([[0, 0, 1]], 3)  # wrong
nusselt.load(5)  # wrong
nusselt.render("room.pbrt")  # wrong
nusselt.render(nusselt.load("room.pbrt"), part="1/2")  # wrong
nusselt.random.points(4, 4)  # wrong
number: int = nusselt.setting_names()  # wrong
