"""Reads the subset of pbrt's text format that the scenes of this repository use, for programs that do not read pbrt.

The result of `read_scene()` is made of lists, dictionaries, numbers and texts and can be written as JSON:

    name       of the file, without its extension
    film       [width, height] in pixels
    camera     origin [m], corner, right, down: as in the files of `nusselt camera`
    materials  dictionaries with name, diffuse, f0 and (perceptual) roughness; f0 is None for matte materials
    meshes     dictionaries with material (an index), positions [m] and triangles (three indices each), in world space
    lights     dictionaries with radiance [W/(sr m^2)] and either
               polygon (its vertices) and two_sided; it emits to the side from which they appear counter-clockwise; or
               tube (begin, end, radius) and finite, which says whether the caps emit

Anything beyond this subset raises ValueError: a peer must never render another scene without a word.
"""
import math
import pathlib
import re

TOKEN = re.compile(r'#[^\n]*|"([^"]*)"|(\[)|(\])|([^\s"\[\]#]+)')
IDENTITY = [[float(i == j) for j in range(4)] for i in range(4)]
IGNORED = ("Sampler", "PixelFilter", "Integrator")  # the driver sets samples and filter itself


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def translation(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def scaling(x, y, z):
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def rotation(degrees, *axis):
    x, y, z = unit(axis)
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    d = 1 - c
    return [[x * x * d + c, x * y * d - z * s, x * z * d + y * s, 0],
            [x * y * d + z * s, y * y * d + c, y * z * d - x * s, 0],
            [x * z * d - y * s, y * z * d + x * s, z * z * d + c, 0],
            [0, 0, 0, 1]]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    length = math.hypot(*v)
    return [x / length for x in v]


def rigid_inverse(m):
    """The inverse of rotations, reflections and translations."""
    columns = [[m[i][j] for i in range(3)] for j in range(3)]
    for i in range(3):
        for j in range(3):
            if abs(sum(a * b for a, b in zip(columns[i], columns[j])) - (i == j)) > 1e-9:
                raise ValueError("the transform of the camera scales or shears")
    return [column + [-sum(a * m[k][3] for k, a in enumerate(column))] for column in columns] + [[0, 0, 0, 1]]


def look_at(*numbers):
    """From world to camera, in pbrt's left-handed camera space."""
    eye, target, up = numbers[:3], numbers[3:6], numbers[6:]
    forward = unit([b - a for a, b in zip(eye, target)])
    right = unit(cross(unit(up), forward))
    rows = [right, cross(forward, right), forward]
    return rigid_inverse([[rows[j][i] for j in range(3)] + [eye[i]] for i in range(3)] + [[0, 0, 0, 1]])


def transform(m, v, w):
    """A point (w = 1) or a direction (w = 0)."""
    return [sum(a * b for a, b in zip(row, [*v, w])) for row in m[:3]]


def triples(numbers):
    if len(numbers) % 3:
        raise ValueError("a list of points without three numbers for each")
    return [numbers[i:i + 3] for i in range(0, len(numbers), 3)]


def tokens_of(file):
    for match in TOKEN.finditer(file.read_text()):
        text, left, right, word = match.groups()
        if match.group().startswith("#"):
            continue
        yield ("text", text) if text is not None else ("word", word or left or right)


class Reader:
    DIRECTIVES = {"Translate": (3, translation), "Scale": (3, scaling), "Rotate": (4, rotation), "LookAt": (9, look_at)}

    def __init__(self, file):
        self.scene = {"name": file.stem, "film": None, "camera": None, "materials": [], "meshes": [], "lights": []}
        self.ctm, self.material, self.emission = IDENTITY, None, None
        self.saved = []
        self.fov = None
        self.root = file.parent
        self.files = []
        self.read(file)
        if not self.scene["camera"]:
            raise ValueError(f"{file}: no WorldBegin")

    def read(self, file):
        self.files.append(file)
        tokens = [*tokens_of(file), ("word", "")]
        position = 0

        def value():
            nonlocal position
            position += 1
            return tokens[position - 1][1]

        def parameters():
            """The parameters by name, with their types. Numbers come as floats."""
            found = {}
            while tokens[position][0] == "text":
                kind, name = value().split()
                values = [value()]
                if values == ["["]:
                    while (item := value()) != "]":
                        values.append(item)
                    values = values[1:]
                if kind not in ("string", "bool"):
                    values = [float(item) for item in values]
                found[name] = values
            return found

        while tokens[position][1] or tokens[position][0] == "text":
            directive = value()
            if directive in self.DIRECTIVES:
                count, function = self.DIRECTIVES[directive]
                self.ctm = multiply(self.ctm, function(*[float(value()) for _ in range(count)]))
            elif directive == "AttributeBegin":
                self.saved.append((self.ctm, self.material, self.emission))
            elif directive == "AttributeEnd":
                self.ctm, self.material, self.emission = self.saved.pop()
            elif directive == "WorldBegin":
                self.begin_world()
            elif directive == "Include":
                name = value()
                beside = file.parent / name  # as in src/scene/import: else relative to the main file
                self.read(beside if beside.exists() else self.root / name)
            elif directive == "NamedMaterial":
                name = value()
                self.material = [m["name"] for m in self.scene["materials"]].index(name)
            elif directive in IGNORED:
                value()
                parameters()
            elif directive in ("Film", "Camera", "MakeNamedMaterial", "AreaLightSource", "Shape"):
                kind = value()
                getattr(self, directive)(kind, Parameters(f"{file}: {directive} {kind}", parameters()))
            else:
                raise ValueError(f"{file}: {directive} is beyond what peers get")

    def Film(self, _, p):
        self.scene["film"] = [int(p.one("xresolution")), int(p.one("yresolution"))]
        p.ignore("filename")

    def Camera(self, kind, p):
        if kind != "perspective":
            raise ValueError(f"camera {kind}")
        self.fov = p.one("fov")
        p.done()
        self.world_to_camera = self.ctm

    def begin_world(self):
        width, height = self.scene["film"]
        # The field of view belongs to the shorter axis.
        half = math.tan(math.radians(self.fov) / 2)
        x, y = half * max(1, width / height), half * max(1, height / width)
        to_world = rigid_inverse(self.world_to_camera)
        self.scene["camera"] = {"origin": transform(to_world, [0, 0, 0], 1),
                                "corner": transform(to_world, [-x, y, 1], 0),
                                "right": transform(to_world, [2 * x, 0, 0], 0),
                                "down": transform(to_world, [0, -2 * y, 0], 0)}
        self.ctm = IDENTITY

    def MakeNamedMaterial(self, name, p):
        kind = p.one("type")
        material = {"name": name, "diffuse": [0.0] * 3, "f0": None, "roughness": None}
        if kind == "diffuse":
            material["diffuse"] = p.get("reflectance")
        elif kind == "coateddiffuse":
            material["diffuse"], material["f0"] = p.get("reflectance"), [0.04] * 3
        elif kind == "conductor" and "reflectance" in p.values:
            material["f0"] = p.get("reflectance")
        elif kind == "conductor":
            material["f0"] = [((n - 1)**2 + k * k) / ((n + 1)**2 + k * k)
                              for n, k in zip(p.get("eta"), p.get("k"), strict=True)]
        else:
            raise ValueError(f"material {kind}")
        if material["f0"]:
            r = p.one("roughness")
            alpha = math.sqrt(r) if p.one("remaproughness", "true") == "true" else r
            material["roughness"] = math.sqrt(alpha)
        p.done()
        self.scene["materials"].append(material)

    def AreaLightSource(self, kind, p):
        if kind != "diffuse":
            raise ValueError(f"light {kind}")
        self.emission = {"radiance": p.get("L"), "two_sided": p.one("twosided", "false") == "true"}
        p.done()

    def Shape(self, kind, p):
        light = self.emission and {"radiance": self.emission["radiance"]}
        if kind == "line":
            if not light:
                raise ValueError("a line that does not emit")
            if any(abs(math.hypot(*column) - 1) > 1e-9 for column in zip(*[row[:3] for row in self.ctm[:3]])):
                raise ValueError("a scaled tube")
            light["tube"] = {"begin": self.point(p.get("p0")), "end": self.point(p.get("p1")),
                             "radius": p.one("radius")}
            light["finite"] = p.one("finite", "true") == "true"
            p.done()
            self.scene["lights"].append(light)
            return
        positions = [self.point(v) for v in triples(p.get("P"))]
        if kind == "polygon":
            triangles = [[0, i, i + 1] for i in range(1, len(positions) - 1)]
        elif kind == "trianglemesh" and not light:
            triangles = [[int(i) for i in triple] for triple in triples(p.get("indices"))]
        else:
            raise ValueError(f"shape {kind}")
        p.done()
        if light:
            light.update(polygon=positions, two_sided=self.emission["two_sided"])
            self.scene["lights"].append(light)
        else:
            self.scene["meshes"].append({"material": self.material, "positions": positions, "triangles": triangles})

    def point(self, v):
        return transform(self.ctm, v, 1)


class Parameters:
    """Parameters of a directive, each of which somebody has to ask for."""

    def __init__(self, where, values):
        self.where, self.values, self.asked = where, values, set()

    def get(self, name):
        self.asked.add(name)
        if name not in self.values:
            raise ValueError(f"{self.where}: no {name}")
        return self.values[name]

    def one(self, name, default=None):
        self.asked.add(name)
        if name not in self.values and default is not None:
            return default
        value, = self.get(name)
        return value

    def ignore(self, name):
        self.asked.add(name)
        self.done()

    def done(self):
        if left := set(self.values) - self.asked:
            raise ValueError(f"{self.where}: {', '.join(sorted(left))} is beyond what peers get")


def read_scene(file):
    return Reader(pathlib.Path(file)).scene


def files_of(file):
    """The files that the scene was read from, each once."""
    return [*dict.fromkeys(Reader(pathlib.Path(file)).files)]


def matte(scene):
    """The scene as `nusselt render --brdf lambert` shows it: only the diffuse albedo is left of materials."""
    return {**scene, "materials": [{**m, "f0": None, "roughness": None} for m in scene["materials"]]}


def one_sided(scene):
    """The scene with polygons that shine to the side of their normal only."""
    return {**scene, "lights": [{**light, "two_sided": False} if "polygon" in light else light
                                for light in scene["lights"]]}


def aside(scene):
    """The scene seen from a few millimetres beside. If the camera is on the axis of a room, edges of the room pass
    through the centres of pixels, and chance decides which surface a ray hits."""
    offset = (0.0061, 0.0047, 0)
    camera = scene["camera"]
    return {**scene, "camera": {**camera, "origin": [x + d for x, d in zip(camera["origin"], offset)]}}


def resized(scene, width, height):
    """The scene with a film of another size and the same proportions."""
    if width * scene["film"][1] != height * scene["film"][0]:
        raise ValueError("another size has to keep the proportions")
    return {**scene, "film": [width, height]}
