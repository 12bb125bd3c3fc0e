#!/usr/bin/env python3
"""Tests of the live page in a browser: links, controls, failures, names for screen readers, shaders.

Usage: tests/page/live_page_test.py [NAME_OF_TEST...]
What it needs, and how it ends without: see live_page.py. PAGE_SCREENSHOTS names a folder for screenshots.
"""
import itertools
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from live_page import LINK, ROOT, WIDTH, Keys, LivePageTest

# What the browser says about fragment shaders in a program as users make it, with a vertex shader of their own; empty if it
# compiles and is linked.
COMPILE = """
const gl = document.createElement("canvas").getContext("webgl2");
const make = (type, text) => {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    return shader;
};
const corners = make(gl.VERTEX_SHADER, `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`);
const messages = arguments[0].map(text => {
    const shader = make(gl.FRAGMENT_SHADER, text);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return gl.getShaderInfoLog(shader) || "does not compile";
    const program = gl.createProgram();
    gl.attachShader(program, corners);
    gl.attachShader(program, shader);
    gl.linkProgram(program);
    const isLinked = gl.getProgramParameter(program, gl.LINK_STATUS);
    const message = isLinked ? "" : gl.getProgramInfoLog(program) || "is not linked";
    gl.deleteProgram(program);
    gl.deleteShader(shader);
    return message;
});
gl.getExtension("WEBGL_lose_context").loseContext();
return messages;
"""
TEXTS = """
const [sampler] = arguments;
return [...document.getElementById("left").options].map(({ value: technique }) =>
    [technique, window.nusselt.shaderText({ technique, heuristic: "balance", sampler })]);
"""
SCREENS = {"phone": (390, 844), "tablet": (768, 1024), "desktop": (1280, 800)}
CATCH_COPIES = "navigator.clipboard.writeText = async text => { window.copied = text }; window.copied = ''"
STATE = "return document.documentElement.dataset.state"


class Files(unittest.TestCase):
    """What needs no browser."""

    def test_types(self):
        def check(project):
            return subprocess.run(["tsc", "--project", project], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True)

        result = check(ROOT / "web")
        self.assertEqual((0, ""), (result.returncode, result.stdout))
        with tempfile.TemporaryDirectory() as folder:
            settings = json.loads((ROOT / "web/tsconfig.json").read_text())
            settings["include"] = ["."]
            (pathlib.Path(folder) / "tsconfig.json").write_text(json.dumps(settings))
            (pathlib.Path(folder) / "wrong.ts").write_text("export const wrong: number = 'text';\n")
            result = check(folder)
        self.assertNotEqual(0, result.returncode)
        self.assertIn("wrong.ts", result.stdout)

    def test_logic(self):
        import build
        with tempfile.TemporaryDirectory() as folder:
            bundle, data = pathlib.Path(folder) / "logic.mjs", pathlib.Path(folder) / "data.json"
            subprocess.run(["esbuild", "--bundle", "--platform=node", "--format=esm", "--log-level=warning",
                            ROOT / "tests/page/logic_test.mjs", f"--outfile={bundle}"], check=True)
            data.write_text(json.dumps({"sources": build.sources(), "scenes": build.scenes(build.SCENES)}))
            environment = {**os.environ, "PAGE_DATA": str(data), "PAGE_SCENES": str(ROOT / "web/scenes.json")}
            result = subprocess.run(["node", "--test", bundle], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                    text=True, env=environment)
        self.assertEqual(0, result.returncode, result.stdout)


class Page(LivePageTest):
    def test_is_small(self):
        html = self.file.read_text()
        self.assertLess(self.file.stat().st_size, 1_000_000)
        data = re.search(r'<script type="application/json" id="data">.*</script>', html)[0]
        self.assertLess(len(html) - len(data), 100_000)

    def test_loads_nothing(self):
        self.open()
        loaded = self.browser.script("return performance.getEntriesByType('resource').map(entry => entry.name)")
        self.assertEqual([], loaded)

    def test_hostile_links_show_the_initial_state(self):
        self.open(f"{LINK}&frames=2")
        expected = self.image(2)
        hostile = ["%", "constructor=1", "toString=1&__proto__=x", "size=%", "left=%FF", "lamps=NaN,,", "roughness=x",
                   "camera=0,5,0,0,0,0", "camera=0,1e999,0,0,0,0", "camera=0,0,0.0001,0,0,0", "camera=0,0,900,0,0,0",
                   "x" * 100_000]
        self.open(f"{'&'.join(hostile)}&{LINK}&frames=2")
        self.assertEqual(expected, self.image(2))
        for link in hostile:
            self.go(f"{LINK}&frames=2&{link}")
            self.assertEqual(expected, self.image(2), link[:40])
            self.assertEqual("ready", self.browser.script(STATE))

    def test_images_are_functions_of_the_link(self):
        """With smooth edges, whatever was shown before, and for each seed."""
        self.open(f"{LINK}&frames=3")
        expected = self.image(3)
        self.choose("#left", "solid_angle")
        self.assertNotEqual(expected, self.image(3))
        self.choose("#left", "area")
        self.assertEqual(expected, self.image(3))
        self.go(f"{LINK}&frames=3&seed=1")
        self.assertNotEqual(expected, self.image(3))

    def test_reference_has_the_edges_of_images(self):
        """Camera rays of both pass pixels in the same places: elsewhere, the edges of a bright tube differ."""
        self.open(f"width={WIDTH}&compare=0&left=projected&frames=12")
        left, reference = self.image(12), self.image(12, "reference")
        self.assertNotEqual(left, reference)

        def difference(other):
            """In the median over pixels that the tube covers at least in part; the panel is darker."""
            differences = sorted(abs(a - b) for a, b in zip(left, other) if a > 8)
            self.assertGreater(len(differences), 50)
            return differences[len(differences) // 2]

        self.assertLess(difference(reference), 0.1)
        # Pixels beside them are brighter or darker, as images with other places of rays would be.
        self.assertGreater(difference(left[3 * WIDTH:]), 0.5)

    def test_waiting_for_compilers_does_not_choose_a_size(self):
        """Frames that draw nothing take no time, which says nothing about the device."""
        self.before_loading("""
            const parameter = WebGL2RenderingContext.prototype.getProgramParameter;
            WebGL2RenderingContext.prototype.getProgramParameter = function(program, name) {
                return name === 0x91b1 && performance.now() < 2000 ? false : parameter.call(this, program, name);
            };""")
        self.open("compare=0&reference=0")
        self.assertEqual(480, self.browser.script("return document.getElementById('canvas').width"))

    def test_a_shader_that_does_not_compile_is_a_message_beside_its_technique(self):
        self.before_loading("""
            const source = WebGL2RenderingContext.prototype.shaderSource;
            WebGL2RenderingContext.prototype.shaderSource = function(shader, text) {
                source.call(this, shader, text.includes("struct PolygonSolidAngle") ? text + "mistake" : text);
            };""")
        self.open(f"{LINK}&frames=2&left=solid_angle")
        failure = self.find(".side .failure")
        self.assertIn("does not compile", failure.text)
        self.choose("#left", "area")
        self.image(2)
        self.assertFalse(failure.is_displayed())
        self.assertEqual("ready", self.browser.script(STATE))

    def test_a_lost_device_stays_lost(self):
        self.open(f"{LINK}&frames=2")
        self.browser.change("const gl = document.getElementById('canvas').getContext('webgl2');"
                            "gl.getExtension('WEBGL_lose_context').loseContext()")
        self.wait("return document.documentElement.dataset.state === 'failed'")
        self.assertIn("load the page again", self.find("#failure").text)
        self.browser.click(self.find("#shadows"))
        self.browser.settle()
        self.assertEqual("failed", self.browser.script(STATE))
        messages = self.browser.messages()
        self.assertEqual([], [message for message in messages if "CONTEXT_LOST" not in message])

    def test_listeners_that_fail_tell_so(self):
        self.open(f"{LINK}&frames=2")
        self.browser.change("const { prototype } = WebGL2RenderingContext; window.texture = prototype.createTexture;"
                            "prototype.createTexture = () => null")
        self.browser.slide(self.find("#lamp-0"), -2)
        self.assertEqual("failed", self.browser.script(STATE))
        self.browser.change("WebGL2RenderingContext.prototype.createTexture = window.texture")
        self.browser.slide(self.find("#lamp-0"), -1)
        self.wait("return document.documentElement.dataset.state === 'ready'")
        self.assertFalse(self.find("#failure").is_displayed())

    def test_all_shaders_compile(self):
        """Alone, as they are copied, in the browser, whose rules are stricter than those of other compilers."""
        self.open()
        scenes = [row["name"] for row in json.loads((ROOT / "web/scenes.json").read_text())]
        for (name, sampler), thick in itertools.product(zip(scenes, ("sobol", "independent"), strict=True), (False, True)):
            self.choose("#scene", name)
            if self.find("#thick").is_selected() != thick:
                self.browser.click(self.find("#thick"))
            texts = dict(self.browser.script(TEXTS, sampler))
            self.assertGreater(len(texts), 20)
            messages = dict(zip(texts, self.browser.script(COMPILE, list(texts.values()))))
            wrong = {technique: message for technique, message in messages.items() if message}
            self.assertEqual({}, wrong, f"{name}, {thick}")
        text = texts["area"]
        self.assertTrue(text.startswith("#version 300 es\n") and "Permission is hereby granted" in text)
        # What does not compile, and what is compiled but not linked.
        self.assertNotEqual([""], self.browser.script(COMPILE, [text + "mistake"]))
        self.assertNotEqual([""], self.browser.script(COMPILE, [text.replace("void main()", "in vec2 place;\nvoid main()")
                                                                .replace("frames = ", "frames = place.xyxy + ")]))
        self.browser.messages() # the browser warns that contexts are lost


class Controls(LivePageTest):
    def changes(self, what, edit, name="left", count=2):
        """Does something, and checks that it changes an image."""
        before = self.image(count, name)
        edit()
        self.assertNotEqual(before, self.image(count, name), what)

    def screen(self):
        """The bytes that the canvas shows."""
        self.browser.settle()
        return self.find("#canvas").screenshot_as_png

    def changes_screen(self, what, edit):
        before = self.screen()
        edit()
        self.assertNotEqual(before, self.screen(), what)

    def test_each_control_has_its_effect(self):
        click = lambda name: lambda: self.browser.click(self.find(f"#{name}"))
        choose = lambda name, value: lambda: self.choose(f"#{name}", value)
        slide = lambda name, value: lambda: self.browser.slide(self.find(f"#{name}"), value)
        image = lambda edit, name="left": lambda: self.changes(edit, edit, name)
        screen = lambda edit: lambda: self.changes_screen(edit, edit)
        effects = {
            "left": image(choose("left", "solid_angle")),
            "left-sampler": image(choose("left-sampler", "independent")),
            "left-heuristic": lambda: self.check_heuristic("left"),
            "left-copy": lambda: self.check_copy("left"),
            "right": image(choose("right", "area"), "right"),
            "right-sampler": image(choose("right-sampler", "independent"), "right"),
            "right-heuristic": lambda: self.check_heuristic("right"),
            "right-copy": lambda: self.check_copy("right"),
            "samples": image(slide("samples", 1)),
            "roughness": image(slide("roughness", 0.6)),
            "lamp-0": image(slide("lamp-0", -2)),
            "lamp-1": image(slide("lamp-1", 1)),
            "smooth": image(click("smooth")),
            "shadows": image(click("shadows")),
            "accumulate": self.check_accumulation,
            "exposure": screen(slide("exposure", 1)),
            "compare": screen(click("compare")),
            "reference": self.check_reference,
            "error": self.check_error,
            "thick": self.check_thick_tubes,
            "scene": self.check_scene,
            "size": self.check_size,
            "link": self.check_link,
            "bring": self.check_bring,
            "reset": self.check_reset,
        }
        self.open(f"width={WIDTH}&reference=0&right=solid_angle&frames=2")
        self.image(2, "right")
        ids = self.browser.script("return [...document.querySelectorAll('input, select, button')].map(node => node.id)")
        self.assertEqual(sorted(effects), sorted(ids))
        for name, check in effects.items():
            with self.subTest(control=name):
                check()

    def check_heuristic(self, side):
        """Those that go with the technique can be chosen, and the link has them. images_test.py compares images."""
        self.assertFalse(self.find(f"#{side}-heuristic").is_enabled())
        self.go(f"width={WIDTH}&reference=0&frames=2&{side}=projected_ltc")
        self.assertTrue(self.find(f"#{side}-heuristic").is_enabled())
        self.choose(f"#{side}-heuristic", "power")
        self.wait(f"return location.hash.includes('{side}-heuristic=power')")
        self.go(f"width={WIDTH}&reference=0&frames=2&{side}=projected_ggx&{side}-heuristic=optimal")
        self.assertEqual("balance", self.find(f"#{side}-heuristic").get_attribute("value"))
        self.go(f"width={WIDTH}&reference=0&right=solid_angle&frames=2")

    def check_copy(self, side):
        """The text is a shader that compiles; where copying is not allowed, it can be copied by hand."""
        self.browser.script(CATCH_COPIES)
        self.browser.click(self.find(f"#{side}-copy"))
        self.wait("return window.copied")
        text = self.browser.script("return window.copied")
        self.assertEqual(text, self.browser.script("return window.nusselt.shaderText(arguments[0])", {
            name: self.find(f"#{side}{suffix}").get_attribute("value")
            for name, suffix in (("technique", ""), ("heuristic", "-heuristic"), ("sampler", "-sampler"))}))
        self.assertEqual([""], self.browser.script(COMPILE, [text]))
        self.browser.messages()
        self.browser.script("navigator.clipboard.writeText = () => Promise.reject(new Error())")
        self.browser.click(self.find(f"#{side}-copy"))
        self.wait("return document.querySelector('dialog textarea')?.value.includes('#version')")
        self.browser.actions().send_keys(Keys.ESCAPE).perform()
        self.wait("return document.querySelector('dialog') === null")

    def check_accumulation(self):
        self.changes("accumulation", lambda: self.browser.click(self.find("#accumulate")), count=1)
        self.changes("frames without accumulation", lambda: self.browser.settle(), count=1)
        self.browser.click(self.find("#accumulate"))

    def check_reference(self):
        self.assertEqual("–", self.find("#number-left").text)
        self.browser.click(self.find("#reference"))
        self.wait("return Number(document.getElementById('number-left').textContent) > 0")

    def check_error(self):
        self.image(2, "reference")
        self.changes_screen("error", lambda: self.browser.click(self.find("#error")))
        self.browser.click(self.find("#reference"))
        self.assertFalse(self.find("#error").is_selected())

    def check_thick_tubes(self):
        self.choose("#left", "area")
        self.choose("#right", "area")
        self.choose("#scene", "room")
        self.changes("thick tubes", lambda: self.browser.click(self.find("#thick")))

    def check_scene(self):
        self.changes("scene", lambda: self.choose("#scene", "floor"))
        self.wait("return !location.hash.includes('scene')")

    def check_size(self):
        self.choose("#size", "320")
        self.wait("return document.getElementById('canvas').width === 320")
        self.choose("#size", str(WIDTH))

    def check_link(self):
        """Another page with the link has the same image."""
        self.browser.script(CATCH_COPIES)
        self.browser.slide(self.find("#lamp-0"), -3)
        self.browser.click(self.find("#link"))
        self.wait("return window.copied")
        before = self.image(2)
        self.open(self.browser.script("return window.copied").split("#")[1])
        self.assertEqual(before, self.image(2))

    def check_bring(self):
        """Lights behind the camera and beside the image, by the button, by Enter and by dragging."""
        places = """return [...document.querySelectorAll('.handle')].map(handle => [handle.style.left, handle.style.top])
            .map(place => place.map(share => parseFloat(share)))"""
        others = re.sub("lamps=[^&]*&?", "", self.browser.script("return location.hash.slice(1)"))
        moved = f"{others}&lamps=0,0,9,0,0,1;-9,0,0,0,0,1"
        self.go(moved)
        behind, beside = self.browser.script(places)
        self.assertEqual(([50, 98], 2), (behind, beside[0]))
        self.changes("bring", lambda: self.browser.click(self.find("#bring")))
        for left, top in self.browser.script(places):
            self.assertTrue(9 < left < 91 and 9 < top < 91, (left, top))
        brought = self.browser.script(places)
        self.browser.click(self.find("#bring"))
        self.browser.settle()
        self.assertEqual(brought, self.browser.script(places), "all are there")
        self.go(moved)
        self.browser.press(self.find("#handle-0"), Keys.ENTER)
        self.assertGreater(90.1, self.browser.script(places)[0][1])
        # A pointer leads a light from behind the camera to where it goes.
        self.go(moved)
        handle = self.find("#handle-0")
        self.browser.show(handle)
        before = self.browser.script(places)[0]
        pointer = self.browser.actions().move_to_element(handle).click_and_hold()
        pointer.move_by_offset(0, -5).move_by_offset(-100, -100).release().perform()
        self.browser.settle()
        left, top = self.browser.script(places)[0]
        self.assertTrue(left < before[0] - 5 and top < before[1] - 5, (before, left, top))

    def check_reset(self):
        self.changes("reset", lambda: self.browser.click(self.find("#reset")))
        self.wait("return !location.hash.includes('lamps')")

    def test_keys(self):
        press = lambda selector, *keys: lambda: self.browser.press(self.find(selector), *keys)
        self.open(f"{LINK}&frames=2")
        initial = self.image(2)
        for what, edit in {
                "view": press("#canvas", Keys.ARROW_LEFT), "zoom": press("#canvas", "+"),
                "moved view": press("#canvas", Keys.SHIFT, Keys.ARROW_UP), "view put back": press("#canvas", Keys.HOME),
                "lamp": press("#handle-0", Keys.ARROW_RIGHT), "lamp in depth": press("#handle-0", Keys.PAGE_UP),
                "lamp put back": press("#handle-0", Keys.HOME),
                "turned lamp": press("#handle-1", Keys.SHIFT, Keys.ARROW_RIGHT),
                "turned lamp put back": press("#handle-1", Keys.HOME)}.items():
            self.changes(what, edit)
        self.assertEqual(initial, self.image(2))
        self.browser.click(self.find("#compare"))
        self.image(2, "right")
        self.changes_screen("divider", press("#divider", Keys.ARROW_RIGHT))
        self.assertEqual("52 % of the left image", self.find("#divider").get_attribute("aria-valuetext"))
        self.changes_screen("divider at the left", press("#divider", Keys.HOME))
        # A light that leaves the image keeps its handle.
        for _ in range(60):
            self.browser.press(self.find("#handle-0"), Keys.ARROW_LEFT)
        self.assertTrue(self.find("#handle-0").is_displayed())
        self.assertEqual("handle-0", self.browser.script("return document.activeElement.id"))

    def test_pointers(self):
        self.open(f"width={WIDTH}&reference=0&right=area&frames=2")
        browser = self.browser
        self.image(2, "right")

        def drag(selector):
            pointer = browser.actions().move_to_element(self.find(selector))
            pointer.click_and_hold().move_by_offset(30, 10).release().perform()

        self.changes_screen("divider", lambda: drag("#divider"))
        for selector in ("#handle-0", "#canvas"):
            # The divider lies over the middle of the canvas.
            browser.script("document.getElementById('divider').hidden = true")
            self.changes(selector, lambda: drag(selector))
        left, top, width, height = browser.box(self.find("#canvas"))

        def touch(kind, *points):
            browser.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
                {"x": left + x * width, "y": top + y * height, "id": i} for i, (x, y) in enumerate(points)]})

        def pinch():
            touch("touchStart", (0.5, 0.7))
            touch("touchStart", (0.5, 0.7), (0.6, 0.7))
            touch("touchMove", (0.45, 0.7), (0.65, 0.7))
            touch("touchEnd")
            browser.settle()

        self.changes("two fingers", pinch)

    def unnamed(self):
        """What can have the focus, but has no name of its own for screen readers."""
        tree = self.browser.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        names = {}
        for node in tree:
            properties = {entry["name"]: entry["value"].get("value") for entry in node.get("properties", [])}
            if properties.get("focusable") and node["role"]["value"] not in ("RootWebArea", "option", "MenuListOption"):
                names.setdefault(node.get("name", {}).get("value", "").strip(), []).append(node["role"]["value"])
        self.assertGreater(len(names), 20)
        return {name: roles for name, roles in names.items() if not name or len(roles) > 1}

    def test_screen_readers_have_a_name_for_each_control(self):
        self.open()
        self.assertEqual({}, self.unnamed())
        self.browser.change("document.getElementById('scene').parentNode.querySelector('span').remove()")
        self.assertNotEqual({}, self.unnamed())

    def test_tab_reaches_all_controls(self):
        self.open(f"width={WIDTH}&reference=0&right=area")
        expected = self.browser.script("""
            return [...document.querySelectorAll("input, select, button, canvas, [tabindex='0'], summary")]
                .filter(node => !node.disabled && node.checkVisibility()).map(node => node.id || node.tagName);""")
        reached = []
        self.browser.script("document.activeElement.blur(); scrollTo(0, 0)")
        for _ in range(len(expected) + 2):
            self.browser.actions().send_keys(Keys.TAB).perform()
            reached.append(self.browser.script("return document.activeElement.id || document.activeElement.tagName"))
        # The link that skips to the controls comes first; the last Tab leaves the page.
        self.assertEqual("A", reached[0])
        self.assertEqual(sorted(expected), sorted(reached[1:-1]))

    def test_fits_screens(self):
        folder = os.environ.get("PAGE_SCREENSHOTS")
        for name, (width, height) in SCREENS.items():
            self.browser.use_screen(width, height, name == "phone")
            self.open(f"width={WIDTH}&reference=0&right=area&frames=2")
            self.image(2, "right")
            self.browser.settle()
            wider = self.browser.script("""
                const isWider = node => node.checkVisibility() && !node.closest(".skip") &&
                    node.getBoundingClientRect().right > document.documentElement.clientWidth + 1;
                const nodes = [...document.body.querySelectorAll("*")];
                return nodes.filter(isWider).map(node => node.outerHTML.slice(0, 80));""")
            self.assertEqual([], wider, name)
            small = self.browser.script("""return [...document.querySelectorAll("input, select, button")].filter(node =>
                node.getBoundingClientRect().height < 16).map(node => node.id)""")
            self.assertEqual([], small, name)
            if folder is not None:
                self.browser.driver.save_screenshot(str(pathlib.Path(folder) / f"page-{name}.png"))
        self.browser.use_screen(1000, 800, False)


if __name__ == "__main__":
    unittest.main()
