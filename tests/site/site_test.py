#!/usr/bin/env python3
"""Tests of the site in a browser without a window.

Usage: tests/site/site_test.py SITE [NAME_OF_TEST...]; SITE is a folder that site/build.py made
Ends with 77 where chromium, chromium-driver or python3-selenium is missing; with CI=true in the environment, that is a
failure.
"""
import html.parser
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "browser"))
from browser import Browser, Keys

SITE = pathlib.Path(sys.argv.pop(1)).resolve()
SCREENS = ((1280, 900, False), (390, 844, True))
# Layouts grow with what does not fit, and so does innerWidth.
WIDER_THAN_SCREEN = """
const [width] = arguments;
return [...document.querySelectorAll("main *")].filter((node) => {
    const box = node.getBoundingClientRect();
    if (box.right <= width + 1 || box.width === 0) return false;
    for (let parent = node.parentElement; parent; parent = parent.parentElement)
        if (["auto", "scroll", "hidden"].includes(getComputedStyle(parent).overflowX)) return false;
    return true;
}).map((node) => node.outerHTML.slice(0, 200)).slice(0, 3);
"""


class Links(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.targets, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if attributes.get("id"):
            self.anchors.add(attributes["id"])
        self.targets += [attributes[name] for name in ("href", "src") if name in attributes]


def broken_links(folder):
    pages = {page.resolve(): Links(page.read_text()) for page in folder.rglob("*.html")}
    for page, links in pages.items():
        for target in links.targets:
            if "://" in target or target.startswith(("data:", "mailto:")):
                continue
            path, _, anchor = target.partition("#")
            file = (page.parent / path).resolve() if path else page
            if not file.is_file():
                yield f"{page.name}: {target}"
            elif anchor and file in pages and anchor not in pages[file].anchors:
                yield f"{page.name}: {target}"


def setUpModule():
    global browser
    browser = Browser()


def tearDownModule():
    browser.quit()


class SiteTest(unittest.TestCase):
    def open(self, page, screen=SCREENS[0]):
        browser.use_screen(*screen)
        browser.open(SITE / page)

    def test_links_lead_somewhere(self):
        self.assertEqual(list(broken_links(SITE)), [])

    def test_links_that_lead_nowhere_are_found(self):
        page = SITE / "broken.html"
        page.write_text('<a href="nowhere.html">a</a><a href="index.html#nothing">b</a><a href="index.html">c</a>')
        self.addCleanup(page.unlink)
        self.assertEqual(list(broken_links(SITE)), ["broken.html: nowhere.html", "broken.html: index.html#nothing"])

    def test_pages_fit_screens_and_print_no_message(self):
        pages = [page for page in sorted(SITE.rglob("*.html")) if "class=\"source\"" not in page.read_text()]
        self.assertGreater(len(pages), 40)
        for page in pages:
            for screen in SCREENS:
                with self.subTest(page=page.relative_to(SITE), width=screen[0]):
                    self.open(page, screen)
                    self.assertEqual(browser.script(WIDER_THAN_SCREEN, screen[0]), [])
                    self.assertLessEqual(browser.script("return document.documentElement.scrollWidth"), screen[0])
                    self.assertEqual(browser.messages(), [])

    def test_formulas_are_typeset(self):
        self.open("docs/techniques/polygon_solid_angle.html")
        self.assertGreater(len(browser.find_all(".katex-display")), 5)
        self.assertNotIn("\\frac", browser.script("return document.querySelector('main').innerText"))
        self.assertIn("KaTeX", browser.script("return getComputedStyle(document.querySelector('.katex')).fontFamily"))

    def test_contents_open_where_there_is_room(self):
        for screen, is_open in zip(SCREENS, (True, False)):
            self.open("index.html", screen)
            self.assertEqual(browser.script("return document.querySelector('nav details').open"), is_open)

    def found(self, words):
        query = browser.find("#query")
        query.clear()
        query.send_keys(words)
        browser.wait_for("return typeof sections !== 'undefined'")
        browser.settle()
        return browser.find_all("#found li")

    def test_the_search_finds_sections(self):
        self.open("docs/accuracy.html")
        browser.press(browser.find("main"), "/")
        self.assertEqual(browser.script("return document.activeElement.id"), "query")
        found = self.found("cylinder finite rad")
        self.assertIn("Cylinder of finite radius", [entry.text for entry in found])
        browser.click(browser.find("a", found[0]))
        self.assertIn("cylinder.html", browser.driver.current_url)

    def test_shortcuts_of_the_browser_stay_its_own(self):
        self.open("index.html")
        focused = "return document.activeElement.id"
        for modifier in (Keys.CONTROL, Keys.ALT, Keys.META):
            browser.actions().key_down(modifier).send_keys("/").key_up(modifier).perform()
            browser.settle()
            self.assertNotEqual(browser.script(focused), "query")
        # Typing a slash into the field writes one.
        browser.actions().send_keys("/").send_keys("/").perform()
        browser.settle()
        self.assertEqual(browser.script(f"{focused} + document.activeElement.value"), "query/")

    def test_the_search_takes_long_texts(self):
        """They do not freeze the page: neither one long word nor many words."""
        self.open("index.html")
        self.found("sampling")
        for text in ("'x'.repeat(1e6)", "'sampling '.repeat(1e5)", "Array.from({ length: 1e5 }, (_, i) => `a${i}`).join(' ')"):
            with self.subTest(text=text):
                taken = browser.script(f"""
                    const query = document.getElementById('query');
                    query.value = {text};
                    const begin = performance.now();
                    return matches(query.value) && performance.now() - begin;""")
                self.assertLess(taken, 1000)
        # Words beyond the last one that counts change nothing.
        words = "a b c d e f g h i j"
        expected = browser.script("return matches(arguments[0]).length", words)
        self.assertGreater(expected, 0)
        self.assertEqual(browser.script("return matches(arguments[0]).length", f"{words} a zzzqqq"), expected)
        self.assertEqual(browser.script("return matches(arguments[0]).length", "a zzzqqq"), 0)
        query = browser.find("#query")
        query.clear()
        query.send_keys("y" * 300)
        self.assertEqual(len(query.get_attribute("value")), 200)

    def test_the_search_takes_any_text(self):
        self.open("index.html")
        for words in ("zzzqqq", "*", "-", "a:b", "<b>", "^2 ~1", "+"):
            with self.subTest(words=words):
                self.found(words)
                self.assertEqual(browser.find_all("#found b"), [])
        self.assertEqual([entry.text for entry in self.found("zzzqqq")], ["Nothing found"])
        browser.press(browser.find("#query"), Keys.ESCAPE)
        self.assertFalse(browser.find("#found").is_displayed())
        self.assertEqual(browser.messages(), [])


if __name__ == "__main__":
    unittest.main()
