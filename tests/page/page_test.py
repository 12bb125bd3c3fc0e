#!/usr/bin/env python3
"""Tests of the live page in a browser without a window, with WebGL on the processor.

Usage: tests/page/page_test.py NUSSELT GLSLANG_VALIDATOR [NAME_OF_TEST...]
Ends with 77 where chromium, chromium-driver, python3-selenium, esbuild or tsc is missing; with CI=true in the environment, that is
a failure.
"""
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/browser"))
from browser import WEBGL, Browser, Keys, unavailable

WIDTH, HEIGHT = 160, 90
BLOCK = 10 # pixels in a row of a block
# Mean squared error of blocks in units of their noise. Its standard deviation is about 0.15: noise itself is estimated.
MOST_NOISE = 1.6
# One image by the technique that compiles fastest.
LINK = f"width={WIDTH}&compare=0&reference=0"

# Waits as long as scripts may take: to compile shaders takes long on a busy machine.
WAIT = """
const [condition, done] = arguments;
const test = new Function(condition);
(function poll() {
    const value = test();
    if (value) done(value);
    else setTimeout(poll, 20);
})();
"""

# The mean of an image after at least some frames, row by row from the top.
IMAGE = """
const [name, count, width, done] = arguments;
(async function poll() {
    if (window.nusselt.frames(name) < count) return setTimeout(poll, 20);
    const values = await window.nusselt.image(name);
    const rows = [];
    for (let i = values.length - 4 * width; i >= 0; i -= 4 * width)
        rows.push(values.slice(i, i + 4 * width).filter((_, k) => k % 4 < 3));
    done([values[3], rows.flat()]);
})();
"""


def read_pfm(file):
    """All numbers of an image with three channels, row by row from the top."""
    kind, size, scale, data = pathlib.Path(file).read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind == b"PF"
    values = struct.unpack(("<" if float(scale) < 0 else ">") + f"{3 * width * height}f", data)
    return [value for y in reversed(range(height)) for value in values[3 * width * y:3 * width * (y + 1)]]


def is_smooth(image):
    """For each number of an image whether its pixel and those around have similar values: no edges, where devices may
    see another surface, because they round positions on the screen."""
    def similar(a, b):
        return all(abs(image[a + k] - image[b + k]) <= 0.3 * max(image[a + k], image[b + k]) for k in range(3))

    result = []
    for y in range(HEIGHT):
        for x in range(WIDTH):
            at = 3 * (y * WIDTH + x)
            around = [at + 3 * (dy * WIDTH + dx) for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1))
                      if 0 <= x + dx < WIDTH and 0 <= y + dy < HEIGHT]
            result += 3 * [all(similar(at, other) for other in around)]
    return result


def block_means(image, mask):
    """Means over blocks of what a mask leaves; None for blocks of which it leaves little."""
    columns = WIDTH // BLOCK
    sums = [0.0] * (3 * columns * (HEIGHT // BLOCK))
    counts = [0] * len(sums)
    for i, (value, counted) in enumerate(zip(image, mask)):
        x, y = i // 3 % WIDTH, i // 3 // WIDTH
        block = 3 * (y // BLOCK * columns + x // BLOCK) + i % 3
        if counted:
            sums[block] += value
            counts[block] += 1
    return [total / count if count >= BLOCK**2 // 4 else None for total, count in zip(sums, counts)]


def mean(values):
    return sum(values) / len(values)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = pathlib.Path(cls.folder.name) / "index.html"
        subprocess.run([ROOT / "web/build.py", cls.file], check=True)
        cls.browser = Browser(WEBGL, ())
        cls.browser.driver.set_script_timeout(300)
        cls.browser.use_screen(1000, 800, False)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def tearDown(self):
        self.assertEqual([], self.browser.messages())

    def open(self, link=LINK):
        self.browser.driver.get("about:blank") # else only the fragment would change
        self.browser.driver.get(f"file://{self.file}#{link}")
        state = self.wait("const { state } = document.documentElement.dataset; return state !== 'loading' && state")
        self.assertEqual("ready", state, self.browser.find("#failure").text)

    def wait(self, condition):
        return self.browser.driver.execute_async_script(WAIT, condition)

    def image(self, count=1, name="left"):
        """The number of frames that add up, and their mean."""
        return self.browser.driver.execute_async_script(IMAGE, name, count, WIDTH)

    def test_is_small(self):
        html = self.file.read_text()
        self.assertLess(self.file.stat().st_size, 1_000_000)
        data = re.search(r'<script type="application/json" id="data">.*</script>', html)[0]
        self.assertLess(len(html) - len(data), 100_000)

    def test_types(self):
        result = subprocess.run(["tsc", "--project", ROOT / "web"], stdout=subprocess.PIPE, text=True)
        self.assertEqual("", result.stdout)

    def test_loads_nothing(self):
        self.open()
        self.assertEqual([], self.browser.script("return performance.getEntriesByType('resource').map(entry => entry.name)"))

    def render(self, scene, *options):
        image = pathlib.Path(self.folder.name) / "image.pfm"
        subprocess.run([NUSSELT, "render", ROOT / scene, "--resolution", f"{WIDTH}x{HEIGHT}", "--spp", "64", "--pixel-center",
                        "-q", "-o", image,
                        *options], check=True)
        return read_pfm(image)

    def z2_of(self, first_count, first, count, all_frames, expected):
        """The mean squared error of blocks in units of their noise: near 1 where images differ by noise alone."""
        mask = is_smooth(expected)
        blocks = [row for row in zip(*(block_means(image, mask) for image in (first, all_frames, expected))) if None not in row]
        self.assertGreater(len(blocks), 150)
        # Variance of the mean of all frames, from the first and the others.
        factor = first_count / (count - first_count)
        noise = sum(factor * (a - f)**2 / (e + 0.01)**2 for f, a, e in blocks)
        return sum((a - e)**2 / (e + 0.01)**2 for _, a, e in blocks) / noise

    def check_against_the_renderer(self, link, frames, file, *options):
        expected = self.render(file, *options)
        self.open(f"{LINK}&smooth=0&frames={frames}&{link}")
        first = self.image(frames // 2)
        last = self.image(frames)
        self.assertAlmostEqual(1, mean(last[1]) / mean(expected), delta=0.01)
        self.assertLess(self.z2_of(*first, *last, expected), MOST_NOISE)
        # The mean notices lights that are brighter by a fiftieth, the blocks that shadows are missing.
        self.assertNotAlmostEqual(1, mean(last[1]) / (1.02 * mean(expected)), delta=0.01)
        self.browser.click(self.browser.find("#shadows"))
        self.assertGreater(self.z2_of(*first, *last, self.image(frames)[1]), 2 * MOST_NOISE)

    def test_area_agrees_with_the_renderer(self):
        self.check_against_the_renderer("left-sampler=independent", 32, "web/scenes/floor.pbrt")

    def test_cylinders_agree_with_the_renderer(self):
        self.check_against_the_renderer("scene=room&thick=1&left-sampler=independent", 24, "scenes/room.pbrt")

    def test_projected_solid_angle_agrees_with_the_renderer(self):
        self.check_against_the_renderer("left=projected&left-sampler=independent", 16, "web/scenes/floor.pbrt")
        # On slow devices, the reference uses the same program.
        self.browser.click(self.browser.find("#reference"))
        self.wait("return Number(document.getElementById('number-left').textContent) > 0")
        before = self.screen()
        self.browser.click(self.browser.find("#error"))
        self.assertNotEqual(before, self.screen())

    def test_two_techniques_agree_with_the_renderer(self):
        self.check_against_the_renderer("left=projected_ltc&left-sampler=independent", 12, "web/scenes/floor.pbrt")
        image = self.image(2)[1]
        for label in ("Balance", "Power", "Weighted balance", "Optimal", "One sample of either", "Separate"):
            image = self.change(label, lambda: self.browser.choose(self.browser.find("#left-heuristic"), label), image)

    def test_all_shaders_compile(self):
        """By another compiler, which takes less time than the browser."""
        self.open()
        for scene in ("floor", "room"):
            self.browser.choose(self.browser.find("#scene"), scene.capitalize())
            if scene == "room":
                self.browser.click(self.browser.find("#thick"))
            texts = self.browser.script("""
                return [...document.getElementById("left").options].map(option => [option.value,
                    window.nusselt.shaderText({ technique: option.value, heuristic: "balance", sampler: "sobol" })]);""")
            self.assertGreater(len(texts), 10)
            for name, text in texts:
                file = pathlib.Path(self.folder.name) / f"{scene}-{name}.frag"
                file.write_text(text)
                result = subprocess.run([GLSLANG, file], stdout=subprocess.PIPE, text=True)
                self.assertEqual(0, result.returncode, f"{scene}, {name}: {result.stdout}")

    def change(self, what, edit, before, count=2):
        """Does something, and checks that it changes the image."""
        edit()
        after = self.image(count)[1]
        self.assertNotEqual(before, after, what)
        return after

    def screen(self):
        """The bytes that the canvas shows."""
        self.image(2)
        self.browser.settle()
        return self.browser.find("#canvas").screenshot_as_png

    def test_controls_change_the_picture(self):
        browser = self.browser
        self.open(f"{LINK}&right=area&frames=2")
        find = browser.find
        image = self.image(2)[1]
        image = self.change("technique", lambda: browser.choose(find("#left"), "Solid angle"), image)
        image = self.change("random numbers", lambda: browser.choose(find("#left-sampler"), "Independent"), image)
        image = self.change("technique", lambda: browser.choose(find("#left"), "Area"), image)
        for slider, value in (("samples", 1), ("roughness", 0.6), ("lamp-0", -2), ("lamp-1", 1)):
            image = self.change(slider, lambda: browser.slide(find(f"#{slider}"), value), image)
        image = self.change("edges", lambda: browser.click(find("#smooth")), image)
        image = self.change("shadows", lambda: browser.click(find("#shadows")), image)
        self.change("adding up", lambda: browser.click(find("#accumulate")), image, 1)
        browser.click(find("#accumulate"))
        image = self.change("view", lambda: browser.press(find("#canvas"), Keys.ARROW_LEFT), self.image(2)[1])
        image = self.change("zoom", lambda: browser.press(find("#canvas"), "+"), image)
        image = self.change("moved view", lambda: browser.press(find("#canvas"), Keys.SHIFT, Keys.ARROW_UP), image)
        for key in (Keys.ARROW_RIGHT, Keys.PAGE_UP):
            image = self.change("lamp", lambda: browser.press(find("#handle-0"), key), image)
        image = self.change("turned lamp", lambda: browser.press(find("#handle-1"), Keys.SHIFT, Keys.ARROW_RIGHT), image)
        self.check_pointers(image)
        # A link leads to the same image, bit by bit.
        link = browser.script("return window.nusselt.link()")
        image = self.image(2)[1]
        self.open(link.split("#")[1])
        self.assertEqual(image, self.image(2)[1])
        browser.click(find("#reset"))
        self.wait("return !location.hash.includes('lamps')")
        shown = self.screen()
        for change in (lambda: browser.slide(find("#exposure"), 1), lambda: browser.click(find("#compare")),
                       lambda: browser.press(find("#divider"), Keys.ARROW_RIGHT)):
            change()
            if find("#compare").is_selected():
                self.image(2, "right")
            before, shown = shown, self.screen()
            self.assertNotEqual(before, shown)

    def check_pointers(self, image):
        browser = self.browser
        for selector in ("#handle-0", "#canvas"):
            drag = browser.actions().move_to_element(browser.find(selector)).click_and_hold().move_by_offset(30, 10).release()
            image = self.change(f"mouse on {selector}", drag.perform, image)
        left, top, width, height = browser.box(browser.find("#canvas"))

        def touch(kind, *points):
            browser.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
                {"x": left + x * width, "y": top + y * height, "id": i} for i, (x, y) in enumerate(points)]})

        def pinch():
            touch("touchStart", (0.5, 0.7))
            touch("touchStart", (0.5, 0.7), (0.6, 0.7))
            touch("touchMove", (0.45, 0.7), (0.65, 0.7))
            touch("touchEnd")

        self.change("two fingers", pinch, image)

    def test_copies_shaders(self):
        self.open()
        self.browser.click(self.browser.find("#left-copy"))
        self.wait("return document.querySelector('.side .copied').textContent || Boolean(document.querySelector('dialog'))")
        for dialog in self.browser.find_all("dialog button"):
            self.browser.click(dialog)

    def test_keyboard_reaches_all_that_has_a_name(self):
        self.open()
        missing = self.browser.script("""
            const nodes = [...document.querySelectorAll("input, select, button, canvas, [role=slider], summary")];
            const named = node => node.ariaLabel || node.labels?.length || node.textContent.trim();
            return nodes.filter(node => !named(node) || node.tabIndex < 0).map(node => node.outerHTML);""")
        self.assertEqual([], missing)


if __name__ == "__main__":
    NUSSELT, GLSLANG = sys.argv[1:3]
    for program in ("esbuild", "tsc"):
        if shutil.which(program) is None:
            unavailable(f"{program} is missing")
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
