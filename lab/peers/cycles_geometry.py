"""Lights as Blender has them, without Blender, so that tests can check them."""
import math

from pbrt_scene import cross, unit

TUBE_SIDES = 12  # a tube as a mesh has this many
OCCLUDER_OFFSET = 1e-4  # [m]


def add(a, b, factor=1):
    return [x + factor * y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def camera_axes(film, camera):
    """The axes of Blender's camera (right, up and backwards) and the horizontal field of view [rad]."""
    right, down = camera["right"], camera["down"]
    forward = add(add(camera["corner"], right, 0.5), down, 0.5)
    axes = [unit(right), unit([-x for x in down]), unit([-x for x in forward])]
    # What a perspective camera of Blender cannot do, such as mirrored or sheared images, must not pass.
    width, height = math.hypot(*right), math.hypot(*down)
    if math.dist(cross(axes[0], axes[1]), axes[2]) > 1e-6 or abs(width / film[0] - height / film[1]) > 1e-6 * width:
        raise ValueError("Blender has no such camera")
    return axes, 2 * math.atan(0.5 * width / math.hypot(*forward))


def lamp_of(polygon, radiance):
    """Position, axes, sides, power and colour of an area light, which shines along its -z axis."""
    a, b, c, d = polygon
    x, y = add(b, a, -1), add(d, a, -1)
    if math.dist(add(a, c), add(b, d)) > 1e-6 or abs(dot(x, y)) > 1e-6:
        raise ValueError("Blender's area lights are rectangles")
    width, height = math.hypot(*x), math.hypot(*y)
    x, y = unit(x), unit(y)
    # The side from which vertices appear counter-clockwise emits: x cross y points there.
    axes = [x, [-v for v in y], [-v for v in cross(x, y)]]
    # A lamp of power E has the radiance E / (4 A), as images of it show.
    return {"center": [0.5 * v for v in add(a, c)], "axes": axes, "width": width, "height": height,
            "power": 4 * width * height * max(radiance), "color": [value / max(radiance) for value in radiance]}


def reversed_side(polygon):
    return polygon[:1] + polygon[:0:-1]


def occluder_of(polygon):
    """A polygon right behind a one-sided one."""
    normal = unit(cross(add(polygon[1], polygon[0], -1), add(polygon[2], polygon[0], -1)))
    return [add(v, normal, -OCCLUDER_OFFSET) for v in polygon]


def tube_mesh(tube, caps):
    """Positions and polygons of a prism with the lateral area of the cylinder. In the mean over all directions from
    which it is seen, it has the same projected area, too. All sides face outwards."""
    begin, end = tube["begin"], tube["end"]
    z = unit(add(end, begin, -1))
    smallest = min(range(3), key=lambda i: abs(z[i]))
    x = unit(cross(z, [float(i == smallest) for i in range(3)]))
    y = cross(z, x)
    half_angle = math.pi / TUBE_SIDES
    radius = tube["radius"] * half_angle / math.sin(half_angle)
    angles = [2 * half_angle * i for i in range(TUBE_SIDES)]
    ring = [[radius * (math.cos(t) * a + math.sin(t) * b) for a, b in zip(x, y)] for t in angles]
    positions = [add(center, v) for center in (begin, end) for v in ring]
    following = [(i + 1) % TUBE_SIDES for i in range(TUBE_SIDES)]
    polygons = [[i, j, TUBE_SIDES + j, TUBE_SIDES + i] for i, j in enumerate(following)]
    if caps:
        polygons += [[*range(TUBE_SIDES - 1, -1, -1)], [*range(TUBE_SIDES, 2 * TUBE_SIDES)]]
    return positions, polygons
