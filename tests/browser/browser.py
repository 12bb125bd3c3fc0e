"""A browser without a window, for tests. Needs chromium, chromium-driver and python3-selenium."""
import os
import shutil
import sys

SKIPPED = 77


def unavailable(reason):
    """Continuous integration must not pass without the tests."""
    print(f"{os.path.basename(sys.argv[0])}: {reason}", file=sys.stderr)
    sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)


try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    # The first python3 of the path may be another than Debian's, which has the package.
    if os.path.exists("/usr/bin/python3") and os.path.realpath(sys.executable) != os.path.realpath("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    unavailable("python3-selenium is missing")

# Pixels are read from a copy, because browsers warn about reading from canvases that are made to be shown.
PIXELS = """
const [source, x, y, width, height] = arguments;
const copy = document.createElement("canvas");
[copy.width, copy.height] = [width, height];
const context = copy.getContext("2d", { willReadFrequently: true });
context.drawImage(source, x, y, width, height, 0, 0, width, height);
return [...context.getImageData(0, 0, width, height).data];
"""

WAIT = """
const [condition, done] = arguments;
const test = new Function(condition);
(function poll() {
    const value = test();
    if (value) done(value);
    else setTimeout(poll, 20);
})();
"""

# Listeners run in the next frame, and what they do is visible in the one after it.
SETTLE = "requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(arguments[arguments.length - 1])));"

SCREEN_PIXELS = """
const [data, places, done] = arguments;
const image = new Image();
image.onload = () => {
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    done(places.map(([x, y]) => [...context.getImageData(x, y, 1, 1).data].slice(0, 3)));
};
image.src = "data:image/png;base64," + data;
"""


# WebGL on the processor.
WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")

# Nobody watches: no need to wait for frames. Not for pages that always draw: they would draw screens and nothing else.
UNPACED = ("--disable-frame-rate-limit", "--disable-gpu-vsync")


class Browser:
    """One for all screens: to start it takes seconds."""

    def __init__(self, graphics=("--disable-gpu",), pacing=UNPACED):
        chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
        if not chromium or not driver:
            unavailable("chromium or chromium-driver is missing")
        options = webdriver.ChromeOptions()
        options.binary_location = chromium
        for argument in ("--headless=new", *graphics, *pacing, "--disable-dev-shm-usage", "--force-color-profile=srgb"):
            options.add_argument(argument)
        if os.geteuid() == 0:  # where the sandbox does not start
            options.add_argument("--no-sandbox")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        options.page_load_strategy = "eager"  # open() waits for what the page says about itself
        self.driver = webdriver.Chrome(service=Service(driver), options=options)
        self.driver.set_script_timeout(30)

    def use_screen(self, width, height, is_mobile):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": is_mobile})

    def quit(self):
        self.driver.quit()

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def open(self, file):
        """Loads the page and returns its state."""
        self.driver.get(f"file://{file}")
        self.wait_for("return document.documentElement.dataset.state !== 'loading'")
        return self.script("return document.documentElement.dataset.state")

    def wait_for(self, condition, *arguments):
        done = self.driver.execute_async_script("""
            const [condition, values, done] = arguments;
            const test = new Function(condition);
            const end = performance.now() + 20000;
            (function poll() {
                if (test.apply(null, values) || performance.now() > end) done(Boolean(test.apply(null, values)));
                else setTimeout(poll, 20);
            })();""", condition, list(arguments))
        assert done, f"never true: {condition}"

    def wait(self, condition):
        """The value of a condition once it is true. Waits as long as scripts may take: to compile shaders takes long on a busy
        machine."""
        return self.driver.execute_async_script(WAIT, condition)

    def settle(self):
        self.driver.execute_async_script(SETTLE)

    def find(self, selector, within=None):
        return (within or self.driver).find_element(By.CSS_SELECTOR, selector)

    def find_all(self, selector, within=None):
        return (within or self.driver).find_elements(By.CSS_SELECTOR, selector)

    def change(self, text, *arguments):
        """A script, and the frames that show what it changed."""
        self.driver.execute_async_script(f"{text};{SETTLE}", *arguments)

    def actions(self):
        """Of the pointer and the keyboard. The pointer jumps."""
        return ActionChains(self.driver, duration=0)

    def show(self, node):
        """Scrolls a node into the middle of the screen."""
        self.change("arguments[0].scrollIntoView({ block: 'center', behavior: 'instant' })", node)

    def click(self, node):
        self.show(node)
        node.click()
        self.settle()

    def press(self, node, *keys):
        """Types keys; those that follow Shift are pressed with it."""
        self.script("arguments[0].focus({ preventScroll: true })", node)
        actions = self.actions()
        for key in keys:
            if key == Keys.SHIFT:
                actions.key_down(key)
            else:
                actions.send_keys(key)
        actions.key_up(Keys.SHIFT).perform()
        self.settle()

    def slide(self, node, value):
        self.change("arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input', { bubbles: true }))",
                    node, value)

    def choose(self, node, text):
        """Takes an entry of a drop-down list."""
        self.change("""const [list, text] = arguments;
            list.selectedIndex = [...list.options].findIndex(option => option.textContent === text);
            list.dispatchEvent(new Event('change', { bubbles: true }))""", node, text)

    def painted(self, canvas):
        """Waits until a canvas shows its image."""
        self.driver.execute_async_script("""const [canvas, done] = arguments;
            (function poll() { if (canvas.dataset.painted) done(); else setTimeout(poll, 20); })();""", canvas)
        return canvas

    def pixel(self, canvas, x, y):
        return self.script(PIXELS, canvas, x, y, 1, 1)[:3]

    def pixels(self, canvas, width, height):
        """All bytes of a canvas, with alpha."""
        return self.script(PIXELS, canvas, 0, 0, width, height)

    def box(self, node):
        """Left, top, width and height on the screen."""
        return self.script("const b = arguments[0].getBoundingClientRect(); return [b.left, b.top, b.width, b.height]", node)

    def screen_pixels(self, places):
        """The colours that the screen shows at positions."""
        return self.driver.execute_async_script(SCREEN_PIXELS, self.driver.get_screenshot_as_base64(),
                                                [[round(x), round(y)] for x, y in places])

    def messages(self):
        return [entry["message"] for entry in self.driver.get_log("browser")]
