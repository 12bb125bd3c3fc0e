"""The live page in a browser without a window, with WebGL on the processor, for its tests.

Needs chromium, chromium-driver, python3-selenium, esbuild, tsc and Node.js; without one, programs that import this end
with 77, and with 1 if CI=true is in the environment.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/browser"))
sys.path.insert(0, str(ROOT / "web"))
from browser import WEBGL, Browser, Keys, unavailable

for program in ("esbuild", "tsc", "node"):
    if shutil.which(program) is None:
        unavailable(f"{program} is missing")

WIDTH, HEIGHT = 160, 90
# One image by the technique that compiles fastest.
LINK = f"width={WIDTH}&compare=0&reference=0"

# The mean of an image after at least some frames, row by row from the top.
IMAGE = """
const [name, count, width, done] = arguments;
(async function poll() {
    if (window.nusselt.frames(name) < count) return setTimeout(poll, 20);
    const image = await window.nusselt.image(name);
    const rows = [];
    for (let i = image.mean.length - 3 * width; i >= 0; i -= 3 * width) rows.push(image.mean.slice(i, i + 3 * width));
    done([image.count, image.rejected, rows.flat()]);
})();
"""


def page_html(scene=None):
    """The text of the page. \\param scene: a text in place of the floor's"""
    import build
    html = build.page()
    if scene is None:
        return html
    data = re.search(r'(<script type="application/json" id="data">)(.*?)(</script>)', html, re.DOTALL)
    values = json.loads(data[2])
    values["scenes"]["web/scenes/floor.pbrt"] = scene
    return html[:data.start(2)] + json.dumps(values).replace("<", "\\u003c") + html[data.end(2):]


class LivePageTest(unittest.TestCase):
    """One browser and one page for all tests of a class."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.file = cls.folder / "index.html"
        cls.file.write_text(page_html())
        cls.browser = Browser(WEBGL, ())
        cls.browser.driver.set_script_timeout(600)
        cls.browser.use_screen(1000, 800, False)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        shutil.rmtree(cls.folder)

    def tearDown(self):
        self.assertEqual([], self.browser.messages())

    def load(self, link=LINK, file=None):
        """Loads the page and returns its state."""
        self.browser.driver.get("about:blank") # else only the fragment would change
        self.browser.driver.get(f"file://{file or self.file}#{link}")
        return self.wait("const { state } = document.documentElement.dataset; return state !== 'loading' && state")

    def open(self, link=LINK, file=None):
        self.assertEqual("ready", self.load(link, file), self.browser.find("#failure").text)

    def wait(self, condition):
        return self.browser.wait(condition)

    def image(self, count=1, name="left"):
        """The mean of all frames of an image, of which there are at least some, row by row from the top."""
        _, rejected, mean = self.browser.driver.execute_async_script(IMAGE, name, count, WIDTH)
        self.assertEqual(0, rejected, "samples that are not finite")
        return mean

    def go(self, link):
        """Follows a link to another state of the page."""
        self.browser.change("location.hash = arguments[0]", link)

    def find(self, selector):
        return self.browser.find(selector)

    def choose(self, selector, value):
        """Takes an entry of a drop-down list."""
        self.browser.change("""const [list, value] = arguments;
            list.value = value;
            list.dispatchEvent(new Event('change', { bubbles: true }))""", self.find(selector), value)

    def before_loading(self, script):
        """Runs a script before those of each page that is opened in this test."""
        found = self.browser.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": script})
        self.addCleanup(self.browser.driver.execute_cdp_cmd, "Page.removeScriptToEvaluateOnNewDocument", found)
