#!/usr/bin/env python3
"""Tests of the module and the example for three.js, in Node.js and in a browser without a window.

Usage: tests/three/three_test.py [NAME_OF_TEST...]
Ends with 77 where chromium, chromium-driver, python3-selenium, esbuild, tsc, npm or the package three are missing; with CI=true
in the environment, that is a failure.
"""
import functools
import http.server
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests/browser"), str(ROOT / "web")]
from browser import WEBGL, Browser, Keys, unavailable
from pictures import smooth_pixels
import build_three

WIDTH, HEIGHT = 160, 90
SCENE = "web/scenes/floor.pbrt"
FRAMES = 2

# Relative errors of pixels. With the same random numbers, the images of three.js and of the live page differ by the rounding
# of positions, which moves samples across edges of shadows.
MOST_ERROR = 0.01
# Of the mean of the diffuse part from that of three.js, whose form factors are those of spheres: too large by up to a tenth at
# grazing angles, by a few thousandths below a light.
MOST_DEVIATION = 0.01

# The mean of frames that begin with the first random numbers, row by row from the top.
IMAGE = """
const { scene, camera, lights, frames, renderer } = window.example;
window.example.mostFrames = 0; // the page draws no more by itself
const [count] = arguments;
frames.smooth = false;
lights.update();
frames.restart();
lights.frame = 0;
for (let i = 0; i < count; ++i) {
    lights.update();
    frames.render(scene, camera);
}
const values = frames.read();
const width = renderer.domElement.width;
const rows = [];
for (let i = values.length - 4 * width; i >= 0; i -= 4 * width)
    rows.push([...values.subarray(i, i + 4 * width)].filter((_, k) => k % 4 < 3));
return rows.flat();
"""

PAGE_IMAGE = """
const [count, width, done] = arguments;
(async function poll() {
    if (window.nusselt.frames("left") < count) return setTimeout(poll, 20);
    const { mean } = await window.nusselt.image("left");
    const rows = [];
    for (let i = mean.length - 3 * width; i >= 0; i -= 3 * width) rows.push(mean.slice(i, i + 3 * width));
    done(rows.flat());
})();
"""


def with_scene(html, edit):
    """A page with another text of its scene."""
    def replace(match):
        data = json.loads(match[2])
        data["scenes"][SCENE] = edit(data["scenes"][SCENE])
        return match[1] + json.dumps(data).replace("<", "\\u003c") + match[3]

    edited, count = re.subn(r'(<script type="application/json" id="data">)(.*?)(</script>)', replace, html, flags=re.DOTALL)
    assert count == 1
    return edited


def simple_materials(text):
    """The scene without what both BRDFs define differently, the diffuse part of coated materials: what is left is Lambert's,
    and a floor of metal."""
    floor = 'MakeNamedMaterial "floor" "string type" "conductor" "float roughness" 0.09 "bool remaproughness" false\n' \
        '  "rgb eta" [ 0.444 0.527 1.094 ] "rgb k" [ 3.695 2.765 1.829 ]\n'
    edited, count = re.subn(r'MakeNamedMaterial "floor"[^\n]*\n[^\n]*\n', floor, text)
    assert count == 1
    # Diffuse materials have no roughness, and the page refuses what it does not show.
    return re.sub(r'"coateddiffuse"(?: "float roughness" [0-9.]+)?', '"diffuse"', edited)


@functools.cache
def made_module():
    """The folder with the module, its types and what makes it a package."""
    folder = pathlib.Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, folder)
    build_three.make_module(folder)
    return folder


def documented(language):
    """The program or the page in docs/three.md."""
    text, = re.findall(rf"^```{language}\n(.*?)^```", (ROOT / "docs/three.md").read_text(), flags=re.DOTALL | re.MULTILINE)
    return text


def mean(values):
    return sum(values) / len(values)


def error(image, expected, mask=None):
    """The root mean square of relative errors."""
    rows = [(a, e) for i, (a, e) in enumerate(zip(image, expected)) if mask is None or mask[i]]
    return mean([((a - e) / (e + 0.01)) ** 2 for a, e in rows]) ** 0.5


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Module(unittest.TestCase):
    def test_in_node(self):
        """Lights and occluders without a device."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            shutil.copy(made_module() / "nusselt-three.js", folder)
            (folder / "node_modules").symlink_to(build_three.PACKAGES / "node_modules")
            test = shutil.copy(ROOT / "tests/three/module_test.mjs", folder)
            done = subprocess.run(["node", test], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(0, done.returncode, done.stdout)
            self.assertEqual("", done.stdout)
            text = (folder / "nusselt-three.js").read_text()
        self.assertEqual({"three"}, set(re.findall(r'from"([^"]*)"', text)))
        self.assertLess(len(text), 250_000)

    def test_lock_file_names_no_host(self):
        packages = json.loads((build_three.THREE / "package-lock.json").read_text())["packages"]
        for name, package in packages.items():
            self.assertNotIn("resolved", package, name)
            if name:
                self.assertIn("integrity", package, name)


    def test_types(self):
        """A program in TypeScript compiles with the types, and each of its mistakes is found."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "node_modules").mkdir()
            (folder / "node_modules/nusselt-three").symlink_to(made_module())
            shutil.copy(ROOT / "tests/three/types_test.ts", folder)
            done = subprocess.run(["tsc", "--strict", "--noEmit", "--target", "es2020", "--moduleResolution", "node",
                                   folder / "types_test.ts", build_three.THREE / "three.d.ts"],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual((0, ""), (done.returncode, done.stdout))
        text = (made_module() / "nusselt-three.d.ts").read_text()
        self.assertNotIn("private", text)
        self.assertIn("* @param radius    > 0.", text)

    def test_example_of_the_documentation_in_a_bundle(self):
        """The package as npm packs it."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            packed = subprocess.run(["npm", "pack", made_module(), "--silent"], cwd=folder, check=True, stdout=subprocess.PIPE, text=True)
            package = folder / "node_modules/nusselt-three"
            package.mkdir(parents=True)
            subprocess.run(["tar", "-xf", folder / packed.stdout.strip(), "-C", package, "--strip-components=1"], check=True)
            self.assertEqual({"LICENSE", "nusselt-three.d.ts", "nusselt-three.js", "package.json"}, {file.name for file in package.iterdir()})
            (folder / "node_modules/three").symlink_to(build_three.PACKAGES / "node_modules/three")
            (folder / "main.js").write_text(documented("js"))
            subprocess.run(["esbuild", "main.js", "--bundle", "--outfile=bundle.js", "--log-level=warning"], cwd=folder, check=True)
            bundle = (folder / "bundle.js").read_text()
        self.assertEqual((1, 0), (bundle.count("AreaLights = class"), bundle.count('require("three")')))


class Example(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder.name)
        build_three.make_example(folder)
        cls.plain = folder / "index.html"
        text = with_scene(cls.plain.read_text(), simple_materials)
        # Random numbers of the page count rows from the top.
        mark = "return ivec2(gl_FragCoord.xy)"
        assert text.count(mark) == 1
        text = text.replace(mark, f"return ivec2(int(gl_FragCoord.x), {HEIGHT - 1} - int(gl_FragCoord.y))")
        cls.file = folder / "simple.html"
        cls.file.write_text(text)
        subprocess.run([ROOT / "web/build.py", folder / "page.html"], check=True)
        cls.page = folder / "simple-page.html"
        cls.page.write_text(with_scene((folder / "page.html").read_text(), simple_materials))
        cls.browser = Browser(WEBGL, ())
        cls.browser.driver.set_script_timeout(600)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def tearDown(self):
        self.assertEqual([], self.browser.messages())

    def open(self, address):
        self.browser.driver.get(f"file://{address}")
        state = self.wait("const { state } = document.documentElement.dataset; return state !== 'loading' && state")
        self.assertEqual("ready", state, self.browser.find("#failure").text)

    def open_example(self, file):
        """The picture alone."""
        self.browser.use_screen(WIDTH, HEIGHT, False)
        self.open(file)
        self.browser.script("document.getElementById('controls').hidden = true")
        self.wait(f"const {{ width, height }} = window.example.renderer.domElement; return width === {WIDTH} && height === {HEIGHT}")

    def wait(self, condition):
        return self.browser.wait(condition)

    def image(self, count=FRAMES):
        return self.browser.script(IMAGE, count)

    def test_agrees_with_the_page(self):
        """Pixel by pixel, with the same random numbers: a panel and a tube, shadows, diffuse surfaces and a floor of metal."""
        self.browser.use_screen(1000, 800, False)
        self.open(f"{self.page}#width={WIDTH}&left=projected_ltc&compare=0&reference=0&smooth=0&frames={FRAMES}")
        expected = self.browser.driver.execute_async_script(PAGE_IMAGE, FRAMES, WIDTH)
        # For each number of the picture.
        mask = [smooth for smooth in smooth_pixels(expected, WIDTH, HEIGHT) for _ in range(3)]
        self.open_example(self.file)
        image = self.image()
        self.assertLess(error(image, expected, mask), MOST_ERROR)
        self.assertAlmostEqual(1, mean(image) / mean(expected), delta=0.005)
        # Mutants: lights that are brighter by a tenth, and no shadows.
        brighten = "window.example.scene.traverse(object => { if (object.isLight || object.isTubeLight) object.intensity *= arguments[0]; })"
        self.browser.script(brighten, 1.1)
        self.assertGreater(error(self.image(), expected, mask), 2 * MOST_ERROR)
        self.browser.script(brighten, 1 / 1.1)
        self.browser.script("window.example.lights.shadows = false")
        self.assertGreater(error(self.image(), expected, mask), 2 * MOST_ERROR)

    def center(self, count):
        """The mean around the centre of the image."""
        image = self.image(count)
        return mean([image[3 * (y * WIDTH + x) + k] for y in range(30, 60) for x in range(60, 100) for k in range(3)])

    def test_is_as_bright_as_three(self):
        """The floor below a panel, diffuse and without shadows, against three.js alone."""
        self.open_example(self.plain)
        self.browser.script("""
            const { scene, camera, orbit, lights } = window.example;
            lights.shadows = false;
            scene.traverse(object => {
                if (object.isTubeLight) object.intensity = 0;
                if (object.material?.isMeshPhysicalMaterial) Object.assign(object.material, { specularIntensity: 0, metalness: 0 });
                if (!object.isRectAreaLight) return;
                object.parent.position.set(0, 4, 2.7);
                object.parent.rotation.set(-Math.PI / 2, 0, 0);
            });
            camera.position.set(0, 2, 6);
            orbit.target.set(0, 0, 2.7);
            orbit.update();""")
        ours = self.center(2)
        self.browser.script("window.example.lights.active = false")
        theirs = self.center(1)
        self.assertGreater(theirs, 0.01)
        self.assertAlmostEqual(1, ours / theirs, delta=MOST_DEVIATION)
        self.browser.script("window.example.scene.traverse(object => { if (object.isRectAreaLight) object.intensity = 1.05; })")
        self.assertNotAlmostEqual(1, ours / self.center(1), delta=MOST_DEVIATION)

    def shown(self):
        """All numbers of the picture when its frames have added up."""
        self.browser.settle()
        self.wait("return window.example.frames.count >= window.example.mostFrames")
        return self.browser.script("return [...window.example.frames.read()]")

    def places(self):
        """Of the camera and of the lamps."""
        return self.browser.script("""
            const { camera, lamps } = window.example;
            return [camera, ...lamps].map(({ position }) => position.toArray());""")

    def test_controls_change_the_picture(self):
        browser = self.browser
        # Few pixels on a large screen, which has room for the controls.
        browser.use_screen(800, 450, False)
        self.open(self.plain)
        browser.script("Object.assign(window.example, { mostFrames: 2, mostPixels: 64 * 36 })")
        browser.use_screen(810, 450, False)
        shown, places = self.shown(), self.places()

        def drag(x, y):
            """From a place on the canvas, in parts of its size from the centre."""
            canvas = browser.find("#canvas")
            _, _, width, height = browser.box(canvas)
            at = (round(width * x), round(height * y))
            browser.actions().move_to_element_with_offset(canvas, *at).perform()
            browser.settle()
            browser.actions().click_and_hold().move_by_offset(20, 10).release().perform()

        lamps = browser.script("""
            const { camera, lamps } = window.example;
            return lamps.map(({ position }) => position.clone().project(camera)).map(({ x, y }) => [x / 2, -y / 2]);""")
        # What changes the picture, and the number of what moves.
        changes = [
            ("roughness", None, lambda: browser.slide(browser.find("#roughness"), 0.8)),
            ("shadows", None, lambda: browser.click(browser.find("#shadows"))),
            ("panel", 1, lambda: drag(*lamps[0])),
            ("tube", 2, lambda: drag(*lamps[1])),
            ("view", 0, lambda: drag(0.1, 0.4)),
            ("three.js alone", None, lambda: browser.click(browser.find("#active"))),
        ]
        for name, moving, change in changes:
            change()
            before, shown = shown, self.shown()
            self.assertNotEqual(before, shown, name)
            places_before, places = places, self.places()
            self.assertEqual([i == moving for i in range(3)], [a != b for a, b in zip(places_before, places)], name)

    def test_controls_leave_room_for_the_picture(self):
        """On a desktop, and on phones in both orientations."""
        self.open_example(self.plain)
        self.browser.script("document.getElementById('controls').hidden = false; window.example.mostFrames = 0")
        for width, height in ((1280, 720), (844, 390), (390, 844)):
            with self.subTest(width=width, height=height):
                self.browser.use_screen(width, height, False)
                self.browser.settle()
                x, y, w, h = self.browser.box(self.browser.find("#canvas"))
                left, top, _, _ = self.browser.box(self.browser.find("#controls"))
                self.assertTrue(x + w <= left or y + h <= top, "the controls cover the picture")
                self.assertGreater(w * h, 0.5 * width * height)
                for control in self.browser.find_all("#controls input"):
                    cx, cy, cw, ch = self.browser.box(control)
                    self.assertTrue(left <= cx and cx + cw <= width and top <= cy and cy + ch <= height)
                self.assertEqual([width, height], self.browser.script(
                    "const { scrollWidth, scrollHeight } = document.documentElement; return [scrollWidth, scrollHeight]"))

    def test_pictures_without_pixels(self):
        """Frames of a canvas that is hidden wait until it is shown."""
        self.open_example(self.plain)
        show = "document.getElementById('view').style.display = arguments[0]"
        self.browser.script(show, "none")
        self.wait("return window.example.renderer.domElement.width === 0")
        self.browser.settle()
        self.browser.script("window.example.frames.restart()")
        self.browser.settle()
        self.assertEqual(0, self.browser.script("return window.example.frames.count"))
        self.browser.script(show, "")
        self.wait("return window.example.frames.count > 1")
        self.assertEqual("ready", self.browser.script("return document.documentElement.dataset.state"))

    def test_example_of_the_documentation_by_an_import_map(self):
        """From a server, as browsers load no modules from disk."""
        folder = pathlib.Path(self.folder.name) / "served"
        folder.mkdir()
        shutil.copy(made_module() / "nusselt-three.js", folder)
        (folder / "node_modules").symlink_to(build_three.PACKAGES / "node_modules")
        (folder / "index.html").write_text(documented("html"))
        (folder / "main.js").write_text(documented("js"))
        handler = functools.partial(QuietHandler, directory=folder)
        with http.server.ThreadingHTTPServer(("localhost", 0), handler) as server:
            threading.Thread(target=server.serve_forever).start()
            self.addCleanup(server.shutdown)
            self.browser.use_screen(WIDTH, HEIGHT, False)
            self.browser.driver.get(f"http://localhost:{server.server_port}/index.html")
            left, right = (WIDTH // 5, 4 * HEIGHT // 5), (4 * WIDTH // 5, 4 * HEIGHT // 5)
            while self.browser.screen_pixels([left]) in ([[0, 0, 0]], [[255, 255, 255]]):
                time.sleep(0.1)
            # The tube is on the left of the box, which shades the floor on its right.
            lit, shaded = self.browser.screen_pixels([left, right])
            server.shutdown()
        self.assertGreater(min(lit), 2 * max(shaded))

    def test_programs_of_other_materials_compile(self):
        """Maps, layers, instances and colours of vertices lead to other programs. They are linked but draw nothing, which
        takes less time."""
        self.open_example(self.plain)
        self.browser.script("window.example.mostFrames = 0")
        logs = self.browser.script("""
            const { scene, camera, lights, renderer, floor } = window.example;
            const mesh = scene.children.find(child => child.material === floor);
            const texture = lights.occluders.nodes; // any
            const before = { ...floor };
            const maps = { map: texture, normalMap: texture, roughnessMap: texture, metalnessMap: texture, aoMap: texture };
            const kinds = [maps, { anisotropy: 0.5 }, { clearcoat: 1, sheen: 1, iridescence: 1 }, { transmission: 0.5, thickness: 1 },
                { flatShading: true, side: 2, vertexColors: true }];
            const logs = [];
            for (const kind of kinds) {
                Object.assign(floor, kind);
                floor.needsUpdate = true;
                lights.update();
                renderer.compile(scene, camera);
                const { program } = renderer.properties.get(floor).currentProgram;
                const gl = renderer.getContext();
                if (gl.getProgramParameter(program, gl.LINK_STATUS)) logs.push("");
                else logs.push(gl.getAttachedShaders(program).map(shader => gl.getShaderInfoLog(shader)).join());
                for (const name of Object.keys(kind)) floor[name] = before[name];
            }
            return logs;""")
        self.assertEqual([""] * 5, logs)


if __name__ == "__main__":
    for program in ("esbuild", "tsc", "npm", "node"):
        if shutil.which(program) is None:
            unavailable(f"{program} is missing")
    try:
        build_three.install()
    except SystemExit as missing:
        unavailable(missing)
    build_three.make_shader()
    unittest.main()
