#!/usr/bin/env python3
"""Tests of the page of reports in a browser without a window, at the widths of a desktop and of a phone.

Usage: tests/report/page_test.py [NAME_OF_TEST...]
Ends with 77 where chromium, chromium-driver or python3-selenium is missing; with CI=true in the environment, that is a
failure.
"""
import functools
import json
import math
import pathlib
import sys
import tempfile
import unittest

import sample_report as sample

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "browser"))
from browser import Browser, Keys

PINK = [255, 20, 147]
BLUE = [0, 68, 170]
RED = [178, 0, 24]


def to_srgb(x):
    """The byte of the screen for a linear value."""
    x = min(1, max(0, x))
    return round(255 * (12.92 * x if x <= 0.0031308 else 1.055 * x**(1 / 2.4) - 0.055))


def luminance(pixel):
    return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]


PICTURE = sample.gradient()
VARIANTS = {"area": sample.changed(PICTURE, 1, 0.4), "solid angle": sample.changed(PICTURE, 2, 0.15),
            "projected solid angle": sample.changed(PICTURE, 3, 0.05)}


@functools.cache
def errors(variant):
    return [luminance(sample.decoded(a)) - luminance(sample.decoded(b))
            for row, reference in zip(VARIANTS[variant], PICTURE) for a, b in zip(row, reference)]


@functools.cache
def percentile(variant):
    sizes = sorted(abs(e) for e in errors(variant) if math.isfinite(e))
    return sizes[math.ceil(0.99 * len(sizes)) - 1]


@functools.cache
def browser():
    return Browser()


def tearDownModule():
    browser().quit()


class PageTest:
    """What all tests share. Subclasses choose a screen."""
    width, height, is_mobile = 0, 0, False

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.browser = browser()
        cls.browser.use_screen(cls.width, cls.height, cls.is_mobile)
        cls.page = sample.page_with(json.dumps(sample.report()))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def tearDown(self):
        self.assertEqual([], self.browser.messages())

    @classmethod
    def open(cls, page):
        file = pathlib.Path(cls.folder.name) / "page.html"
        file.write_text(page)
        cls.state = cls.browser.open(file)
        cls.noise = next(iter(cls.browser.find_all("[data-experiment=noise]")), None)

    def near(self, expected, pixel, tolerance=1):
        """Bytes may differ by one, where values are rounded from single or from double precision."""
        for a, b in zip(expected, pixel):
            self.assertLessEqual(abs(a - b), tolerance, f"{expected} and {pixel}")

    def color(self, pixel, stops=0):
        return [to_srgb(value * 2**stops) for value in sample.decoded(pixel)]

    def control(self, selector):
        return self.browser.find(f".viewer {selector}", self.noise)

    def choose_mode(self, mode):
        self.browser.click(self.control(f"input[value={mode}]"))

    def compare(self, left, right):
        lists = self.browser.find_all(".viewer select", self.noise)
        self.browser.choose(lists[0], left)
        self.browser.choose(lists[1], right)

    def canvases(self):
        """Those of the viewer, painted."""
        self.browser.show(self.control(".stage"))
        return [self.browser.painted(canvas) for canvas in self.browser.find_all(".viewer canvas", self.noise)]

    def figure(self, index):
        figure = self.browser.find(f".figures figure[data-image='{index}']", self.noise)
        self.browser.show(figure)
        return self.browser.painted(self.browser.find("canvas", figure))

    def row(self, item):
        return self.browser.find(f"tr[data-item='{item}']")

    def check_status(self):
        for item, status, reason in [("a-figure-1", "reproduced", ""), ("a-figure-2", "own scene", "is lost"),
                                     ("a-figure-3", "partly", ""), ("a-table-1", "partly", "never published"),
                                     ("a-figure-4", "partly", ""), ("a-section-6", "partly", "Lacks: Nobody measures more."),
                                     ("a-section-5", "not applicable", "no textures"),
                                     ("a-figure-9", "missing", "no experiment with motion"), ("a-figure-10", "not run", "")]:
            self.assertEqual(status, self.browser.find(".badge", self.row(item)).text)
            self.assertIn(reason, self.row(item).text)

    def check_exposure(self):
        canvas = self.canvases()[0]
        for stops in (0, 1, -2.5):
            self.browser.slide(self.control(".exposure"), stops)
            for x, y in ((0, 0), (40, 30), (95, 63), (7, 5)):
                self.near(self.color(VARIANTS["area"][y][x], stops), self.browser.pixel(canvas, x, y))
        self.near(PINK, self.browser.pixel(canvas, 7, 6), 0)

    def check_wipe(self):
        self.choose_mode("wipe")
        self.compare("area", "reference")
        self.canvases()
        box = self.browser.box(self.control(".frame"))

        # Away from the divider and its handle.
        y = 10
        places = [(box[0] + box[2] * (x + 0.5) / 96, box[1] + box[3] * (y + 0.5) / 64) for x in (40, 55)]
        shown = self.browser.screen_pixels(places)
        self.near(self.color(VARIANTS["area"][y][40]), shown[0], 2)
        self.near(self.color(PICTURE[y][55]), shown[1], 2)
        return places

    def check_errors(self):
        self.compare("area", "reference")
        self.choose_mode("error")
        canvas, reference = self.canvases()
        scale = percentile("area")
        for x, y in ((0, 0), (40, 30), (95, 63), (7, 5), (7, 7)):
            error = errors("area")[96 * y + x]
            end = BLUE if error < 0 else RED
            expected = [255 + min(1, abs(error) / scale) * (value - 255) for value in end]
            self.near(expected, self.browser.pixel(canvas, x, y))
        self.near(PINK, self.browser.pixel(canvas, 7, 6), 0)
        self.near(self.color(PICTURE[30][40]), self.browser.pixel(reference, 40, 30))  # which has no error

    def readout(self):
        return [[cell.text.replace("−", "-") for cell in self.browser.find_all("th, td", row)]
                for row in self.browser.find_all(".pixels tbody tr", self.noise)]

    def check_values(self):
        self.canvases()
        frame = self.control(".frame")
        _, _, width, height = self.browser.box(frame)
        offset = [round((7.5 / 96 - 0.5) * width), round((5.5 / 64 - 0.5) * height)]
        self.browser.actions().move_to_element_with_offset(frame, *offset).perform()
        self.browser.settle()
        rows = self.readout()
        self.assertEqual(["area", "0", "0", "0"], rows[0])
        self.assertEqual("reference", rows[1][0])
        for text, value in zip(rows[1][1:], sample.decoded(PICTURE[5][7])):
            self.assertAlmostEqual(value, float(text), delta=1e-3 * value)


class Reading(PageTest):
    """Tests that change nothing share one page: to load it takes longer than most of them."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.open(cls.page)

    def test_is_ready(self):
        self.assertEqual("ready", self.state)
        self.assertEqual("Reproduction of published results", self.browser.driver.title)

    def test_texts_are_never_markup(self):
        self.assertEqual([], self.browser.find_all("img, b"))
        self.assertEqual(2, len(self.browser.find_all("script")))
        hostile = self.browser.find_all("[data-experiment]")[1]
        self.assertEqual(sample.HOSTILE, hostile.get_attribute("data-experiment"))
        for selector in ("h3", ".source", ".command code", ".facts dd", ".expectations .text", "caption", "th .unit",
                         "td", ".plot figcaption", ".plot .label", ".legend li", ".inset span"):
            texts = [self.browser.script("return arguments[0].textContent", node)
                     for node in self.browser.find_all(selector, hostile)]
            self.assertTrue(any(sample.HOSTILE in text for text in texts), f"{selector}: {texts}")

    def test_controls_have_names(self):
        nameless = self.browser.script("""
            return [...document.querySelectorAll("button, input, select, [role=slider], [tabindex='0']")].filter(node =>
                !node.getAttribute("aria-label") && !node.textContent.trim() && !node.closest("label")?.textContent.trim())
                .map(node => node.outerHTML)""")
        self.assertEqual([], nameless)

    def test_dark_theme(self):
        background = "return getComputedStyle(document.body).backgroundColor"
        colors = []
        for scheme in ("light", "dark"):
            self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                                {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
            colors.append(self.browser.script(background))
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
        self.assertEqual(["rgb(255, 255, 255)", "rgb(20, 23, 27)"], colors)

    def test_summary_counts(self):
        counts = {node.get_attribute("data-count"): node.find_element("tag name", "dd").text
                  for node in self.browser.find_all("[data-count]")}
        self.assertEqual({"reproduced": "1", "own": "1", "partly": "5", "not-applicable": "1", "missing": "1", "not-run": "1",
                          "holds": "3", "fails": "2", "not_evaluated": "2"}, counts)

    def values(self, item):
        return [[cell.text for cell in self.browser.find_all("th, td", row)]
                for row in self.browser.find_all(".comparison tbody tr", self.row(item))]

    def test_published_and_measured_values(self):
        self.assertEqual([["RMSE of area", "0.9000", "0.9307", "1.03"],
                          ["time", "0.01250 µs", "12.30 ns", "–"],  # no ratio of different units
                          ["rank", "first", "none", "–"],
                          ["speed-up", "none", "2.130", "–"]], self.values("a-figure-3"))
        self.assertEqual([["bias", "0.01000", "–", "–"]], self.values("a-table-1"))
        self.assertEqual([], self.values("a-figure-9"))

    def test_status_and_reasons(self):
        self.check_status()

    def test_links_lead_to_experiments(self):
        for link in self.browser.find_all("a[href^='#']"):
            target = link.get_attribute("href").split("#", 1)[1]
            self.assertTrue(self.browser.script("return document.getElementById(decodeURIComponent(arguments[0])) !== null",
                                                target), target)
        links = [link.text for link in self.browser.find_all(".links a", self.row("a-figure-3"))]
        self.assertEqual(["noise", "slow"], links)

    def test_what_was_not_evaluated_is_no_success(self):
        states = [(node.get_attribute("data-state"), self.browser.find(".state", node).text)
                  for node in self.browser.find_all(".expectations li")]
        self.assertEqual([("holds", "holds"), ("fails", "fails"), ("not_evaluated", "not evaluated"),
                          ("not_evaluated", "not evaluated"),  # an unknown state
                          ("holds", "holds"), ("holds", "holds"), ("fails", "fails")], states)

    def test_later_quick_runs_are_shown_beside_full_ones(self):
        late = self.browser.find("[data-experiment=late]")
        self.assertIn("later quick run, 2026-11-21 10:20", self.browser.find(".later h4", late).text.lower())
        self.assertEqual(1, len(self.browser.find_all(".later .fails[data-state]", late)))
        self.assertEqual(1, len(self.browser.find_all(".later")))

    def test_numbers_in_tables(self):
        table = self.browser.find(".numbers", self.noise)
        rows = [[cell.text for cell in self.browser.find_all("td", row)] for row in self.browser.find_all("tbody tr", table)]
        self.assertEqual([["area", "0.9307", "12.35", "61440"], ["solid angle", "0.7282", "–", "61440"],
                          ["projected solid angle", "1.235e-5", "1.235e6", "61440"]], rows)
        heads = [cell.text for cell in self.browser.find_all("thead th", table)]
        self.assertEqual(["technique", "rmse [radiance]", "time per sample [ns]", "rays"], heads)
        aligned = self.browser.script("return [...arguments[0].querySelectorAll('tbody tr:first-child td')].map(cell => "
                                      "getComputedStyle(cell).textAlign)", table)
        self.assertEqual(["right"] * 3, aligned[1:])

    def test_metrics(self):
        texts = [" ".join(node.text.split()) for node in self.browser.find_all(".metrics", self.noise)]
        self.assertEqual("RMSE 0.9307 FLIP 0.1490", texts[0])
        self.assertEqual("RMSE 0.7270 FLIP – relative RMSE 0.02853", texts[2])

    def test_plots(self):
        plots = self.browser.find_all(".plot", self.noise)
        curves = self.browser.find_all(".series", plots[0])
        self.assertEqual([11, 10], [len(self.browser.find_all(".point", curve)) for curve in curves])
        # A value that is not finite interrupts the curve, but not the band.
        path = "return arguments[0].querySelector('.curve').getAttribute('d').split('M').length - 1"
        self.assertEqual([1, 2], [self.browser.script(path, curve) for curve in curves])
        self.assertEqual(2, len(self.browser.find_all(".band", plots[0])))
        self.assertEqual(["independent", "stratified"], [node.text for node in self.browser.find_all(".legend li", plots[0])])
        for path in self.browser.script("return [...document.querySelectorAll('svg path')].map(p => p.getAttribute('d'))"):
            self.assertRegex(path, r"^(M[^NIu]*)?$")  # no NaN, Infinity or undefined
        # Both axes are logarithmic: y = x^-1/2 is a line.
        places = [self.browser.box(point) for point in self.browser.find_all(".point", curves[0])]
        slopes = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(places, places[1:])]
        self.assertLess(max(slopes) - min(slopes), 0.05 * max(slopes))

    def test_given_drawings_are_harmless(self):
        given = self.browser.find(".given", self.noise)
        self.assertIn("drawn elsewhere", given.text)
        self.assertEqual([], self.browser.find_all("script, image", given))
        self.assertIsNone(self.browser.find("svg", given).get_attribute("onload"))
        damaged = self.browser.find_all("[data-experiment]")[1]
        self.assertIn("cannot be drawn", self.browser.find(".plots .failure", damaged).text)


class Using(PageTest):
    """Tests that change what the page shows."""

    def setUp(self):
        self.open(self.page)

    def test_nothing_is_wider_than_the_screen(self):
        self.choose_mode("error")
        self.compare("area", "projected solid angle")
        for mode in ("flip", "wipe", "pair", "all"):
            self.choose_mode(mode)
            self.canvases()
            self.assertEqual(self.width, self.browser.script("return innerWidth"))
            self.assertTrue(
                self.browser.script("return document.documentElement.scrollWidth <= document.body.clientWidth"), mode)

    def test_prints_all_figures(self):
        self.browser.script("""window.print = () => { window.printed =
            [...document.querySelectorAll(".picture canvas")].filter(canvas => canvas.width > 1).length }""")
        self.browser.click(self.browser.find(".print"))
        self.browser.wait_for("return window.printed !== undefined")
        self.assertEqual(5, self.browser.script("return window.printed"))  # the sixth is damaged
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.assertFalse(self.browser.find(".viewer").is_displayed())
        self.assertTrue(self.browser.find(".figures").is_displayed())
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})

    def test_copies_the_command(self):
        self.browser.click(self.browser.find(".copy", self.noise))
        self.browser.wait_for("return document.querySelector('[data-experiment=noise] .copied').textContent !== ''")
        self.assertEqual("Copied", self.browser.find(".copied", self.noise).text)

    def test_exposure(self):
        self.check_exposure()
        self.assertEqual("−2.5 stops", self.browser.find(".viewer .field output", self.noise).text)
        self.near(self.color(PICTURE[30][40], -2.5), self.browser.pixel(self.figure(0), 40, 30))
        self.browser.click(self.control(".exposure-reset"))
        self.near(self.color(VARIANTS["area"][30][40]), self.browser.pixel(self.canvases()[0], 40, 30))
        self.browser.press(self.control(".frame"), "]", "]")
        self.near(self.color(VARIANTS["area"][30][40], 1), self.browser.pixel(self.canvases()[0], 40, 30))

    def test_encoded_bytes_reach_the_screen(self):
        canvas = self.browser.find_all("[data-experiment]")[1].find_element("css selector", ".figures canvas")
        self.browser.show(canvas)
        self.browser.painted(canvas)
        self.assertEqual([value for y in range(32) for x in range(64) for value in (4 * x, 255 - 4 * x, 8 * y, 255)],
                         self.browser.pixels(canvas, 64, 32))

    def test_damaged_images_are_named(self):
        figure = self.browser.find_all("[data-experiment]")[1].find_elements("css selector", ".figures figure")[1]
        self.browser.show(figure)
        self.browser.wait_for("return [...document.querySelectorAll('figure > .failure')].some(node => !node.hidden)")
        self.assertIn("cannot be shown", figure.text)

    def test_flip(self):
        self.compare("solid angle", "reference")
        colors = [self.color(VARIANTS["solid angle"][40][50]), self.color(PICTURE[40][50])]
        left, right = self.canvases()
        box = self.browser.box(self.control(".frame"))
        place = [(box[0] + box[2] * 50.5 / 96, box[1] + box[3] * 40.5 / 64)]
        for step, expected in enumerate((0, 1, 0, 1)):
            self.assertEqual([expected == 0, expected == 1], [left.is_displayed(), right.is_displayed()])
            self.near(colors[expected], self.browser.screen_pixels(place)[0], 2)
            if step % 2 == 0:
                self.browser.press(self.control(".frame"), "f")
            else:
                self.browser.click(self.control(".flip"))
                self.browser.show(self.control(".stage"))

    def test_wipe(self):
        places = self.check_wipe()
        divider = self.control(".divider")
        self.assertEqual("50", divider.get_attribute("aria-valuenow"))
        width = self.browser.box(self.control(".frame"))[2]
        self.browser.actions().move_to_element(divider).click_and_hold().move_by_offset(round(width / 4), 0) \
            .release().perform()
        self.browser.settle()
        self.assertIn(divider.get_attribute("aria-valuenow"), ("74", "75", "76"))
        self.near(self.color(VARIANTS["area"][10][55]), self.browser.screen_pixels(places)[1], 2)
        self.browser.press(divider, Keys.HOME)
        self.near(self.color(PICTURE[10][40]), self.browser.screen_pixels(places)[0], 2)
        self.browser.press(divider, Keys.ARROW_RIGHT)
        self.assertEqual("2", divider.get_attribute("aria-valuenow"))

    def test_swap(self):
        self.browser.click(self.control(".swap"))
        self.near(self.color(PICTURE[30][40]), self.browser.pixel(self.canvases()[0], 40, 30))

    def test_side_by_side_stays_in_step(self):
        for mode, count in (("pair", 2), ("all", 4)):
            self.choose_mode(mode)
            frames = self.browser.find_all(".viewer .frame", self.noise)
            self.assertEqual(count, len(frames))
            self.browser.click(self.control(".zoom-in"))
            self.browser.press(frames[1], Keys.ARROW_RIGHT)
            inner = [self.browser.box(canvas) for canvas in self.canvases()]
            outer = [self.browser.box(frame) for frame in frames]
            offsets = [[a[0] - b[0], a[1] - b[1], a[2] / b[2]] for a, b in zip(inner, outer)]
            for offset in offsets:
                self.near(offsets[0], offset, 0.1)
            self.assertAlmostEqual(2, offsets[0][2], places=2)
            self.browser.press(frames[0], "0")

    def test_zoom_and_pan(self):
        frame = self.control(".frame")
        canvas = self.canvases()[0]
        width = self.browser.box(frame)[2]
        self.browser.press(frame, "+", "+")
        self.assertAlmostEqual(4, self.browser.box(canvas)[2] / width, places=2)
        before = self.browser.box(canvas)
        self.browser.actions().move_to_element(frame).click_and_hold().move_by_offset(-30, 20).release().perform()
        self.browser.settle()
        after = self.browser.box(canvas)
        self.near([-30, 20], [after[0] - before[0], after[1] - before[1]], 1)
        self.browser.press(frame, *[Keys.ARROW_LEFT] * 30)
        self.assertAlmostEqual(self.browser.box(frame)[0], self.browser.box(canvas)[0], delta=1)  # its edge, no further
        self.browser.press(frame, "1")
        self.assertAlmostEqual(max(96, width), self.browser.box(canvas)[2], delta=1)
        self.browser.click(self.control(".zoom-in"))
        self.browser.click(self.control(".zoom-fit"))
        self.assertAlmostEqual(width, self.browser.box(canvas)[2], delta=1)

    def test_the_wheel_zooms_after_a_click(self):
        frame, canvas = self.control(".frame"), self.canvases()[0]
        self.browser.script("document.activeElement.blur()")
        wheel = "arguments[0].dispatchEvent(new WheelEvent('wheel', { deltaY: -200, bubbles: true, cancelable: true, " \
                "clientX: arguments[1], clientY: arguments[2], ctrlKey: arguments[3] }))"
        left, top, width, height = self.browser.box(frame)
        self.browser.script(wheel, frame, left + width / 4, top + height / 4, False)
        self.browser.settle()
        self.assertAlmostEqual(width, self.browser.box(canvas)[2], delta=1)
        self.browser.script(wheel, frame, left + width / 4, top + height / 4, True)
        self.browser.settle()
        # The place under the pointer stays where it is.
        self.near([left - width / 4, top - height / 4, 2 * width, 2 * height], self.browser.box(canvas), 1)

    def test_errors(self):
        self.check_errors()
        self.assertIn(f"below {percentile('area'):.3g}", self.control(".scale .note").text)
        self.assertEqual(f"±{percentile('area'):.3g}", self.control(".scale output").text)

    def test_scale_of_errors(self):
        self.choose_mode("error")
        canvas = self.canvases()[0]
        error = errors("area")[96 * 30 + 40]
        end = BLUE if error < 0 else RED
        scale = 4 * percentile("area")
        self.browser.slide(self.control(".error-scale"), 2)
        expected = [255 + min(1, abs(error) / scale) * (value - 255) for value in end]
        self.near(expected, self.browser.pixel(canvas, 40, 30))
        self.browser.choose(self.browser.find_all(".viewer select", self.noise)[1], "solid angle")
        self.canvases()
        outputs = lambda: [node.text for node in self.browser.find_all(".viewer .scale output", self.noise)]
        self.assertEqual([f"±{scale:.3g}", f"±{percentile('solid angle'):.3g}"], outputs())
        self.browser.click(self.control(".same-scale"))
        self.assertEqual([f"±{scale:.3g}"] * 2, outputs())
        self.figure(3)
        self.assertIn(f"+{scale:.3g}", self.browser.find("figure[data-image='3'] .scale-note", self.noise).text)
        self.browser.click(self.control(".own-scale"))
        self.assertEqual([f"±{percentile('area'):.3g}", f"±{percentile('solid angle'):.3g}"], outputs())

    def test_insets(self):
        figure = self.browser.find(".figures figure[data-image='1']", self.noise)
        self.figure(1)
        for index, (left, top) in enumerate(((0, 0), (48, 24))):
            inset = self.browser.find_all(".inset canvas", figure)[index]
            self.assertEqual([24, 16], self.browser.script("return [arguments[0].width, arguments[0].height]", inset))
            for x, y in ((0, 0), (23, 15), (7, 5)):
                self.near(self.color(VARIANTS["area"][top + y][left + x]), self.browser.pixel(inset, x, y))
            shown = self.browser.script("return arguments[0].clientWidth", inset) / 24
            self.assertEqual(round(shown), shown)
            self.assertGreaterEqual(shown, 2)
        picture = self.browser.box(self.browser.find(".picture", figure))
        mark = self.browser.box(self.browser.find_all(".mark", figure)[1])
        self.near([0.5 * picture[2], 0.375 * picture[3], 0.25 * picture[2], 0.25 * picture[3]],
                  [mark[0] - picture[0], mark[1] - picture[1], mark[2], mark[3]], 1)
        frame = self.control(".frame")
        self.browser.press(frame, "+")
        outer, mark = self.browser.box(frame), self.browser.box(self.browser.find_all(".viewer .mark", self.noise)[1])
        self.near([0.5 * outer[2], 0.25 * outer[3], 0.5 * outer[2], 0.5 * outer[3]],
                  [mark[0] - outer[0], mark[1] - outer[1], mark[2], mark[3]], 2)

    def test_values_under_the_pointer(self):
        self.check_values()
        self.browser.press(self.control(".frame"), Keys.SHIFT, Keys.ARROW_DOWN)
        self.assertEqual(["area", "not finite", "not finite", "not finite"], self.readout()[0])
        self.assertIn("Pixel 7, 6", self.control(".pixels caption").text)
        self.browser.press(self.control(".frame"), "e")
        self.assertEqual("not finite", self.readout()[0][4])
        self.browser.press(self.control(".frame"), Keys.SHIFT, Keys.ARROW_DOWN)
        self.assertAlmostEqual(errors("area")[96 * 7 + 7], float(self.readout()[0][4]), delta=1e-3)

    def test_pixels_are_forgotten_far_from_the_screen(self):
        self.canvases()
        self.browser.script("scrollTo(0, 0)")
        far = self.browser.script("return document.querySelector('[data-experiment=noise] .stage').getBoundingClientRect().top")
        if far < 2 * self.height:
            self.browser.script("document.getElementById('papers').style.marginBottom = '5000px'")
        self.browser.wait_for("return document.querySelector('[data-experiment=noise] .stage canvas').width === 1")
        self.near(self.color(VARIANTS["area"][30][40]), self.browser.pixel(self.canvases()[0], 40, 30))


class Loading(PageTest):
    """Tests of other pages."""

    def test_damaged_data_is_an_error(self):
        texts = ["{", "null", '{"papers": 1, "experiments": []}', '{"papers": [{"items": 5}], "experiments": []}',
                 json.dumps(sample.report())[:5000]]
        for text in texts:
            self.open(sample.page_with(text))
            self.assertEqual("failed", self.state)
            self.assertTrue(self.browser.find("[role=alert]").is_displayed())

    def test_an_empty_report_is_no_error(self):
        self.open(sample.page_with('{"papers": [], "experiments": []}'))
        self.assertEqual("ready", self.state)

    def test_mutants(self):
        for text, mistake, check in [
                ("kTransferSize * 2 ** stops", "kTransferSize * 1.9 ** stops", self.check_exposure),
                ("2 ** (e - 136)", "2 ** (e - 136) * 1.02", self.check_exposure),
                ("inset(0 0 0 ${shown}px)", "inset(0 ${shown}px 0 0)", self.check_wipe),
                ("errors[i] < 0 ?", "errors[i] > 0 ?", self.check_errors),
                ("Math.ceil(0.99 * sorted.length) - 1", "Math.ceil(0.95 * sorted.length) - 1", self.check_errors),
                ('stateOf(expectation) !== "holds"', 'stateOf(expectation) === "not_evaluated"', self.check_status),
                ('...(experiment.later?.expectations ?? [])', '', self.check_status),
                ("const index = y * image.width + x;", "const index = x * image.width + y;", self.check_values)]:
            self.assertEqual(1, self.page.count(text), text)
            self.open(self.page.replace(text, mistake))
            with self.assertRaises(AssertionError, msg=mistake):
                check()


class Desktop:
    width, height = 1440, 900


class Phone:
    width, height, is_mobile = 390, 844, True


class DesktopReading(Desktop, Reading, unittest.TestCase):
    pass


class DesktopUsing(Desktop, Using, unittest.TestCase):
    pass


class DesktopLoading(Desktop, Loading, unittest.TestCase):
    pass


class PhoneReading(Phone, Reading, unittest.TestCase):
    pass


class PhoneUsing(Phone, Using, unittest.TestCase):
    pass


class PhoneLoading(Phone, Loading, unittest.TestCase):
    pass


if __name__ == "__main__":
    unittest.main()
