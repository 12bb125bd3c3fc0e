#!/usr/bin/env python3
"""A page from disk takes samples with the script that has everything, in Chromium without a window.

Usage: tests/wasm/page_test.py PACKAGE FOLDER    (FOLDER gets the page; needs tests/browser in PYTHONPATH)
Ends with 77 where chromium, chromium-driver or python3-selenium is missing; with CI=true in the environment, that is a
failure.
"""
import math
import pathlib
import sys

from browser import Browser

PAGE = """<!doctype html>
<html data-state="loading">
<meta charset="utf-8">
<title>Nusselt</title>
<script src="{script}"></script>
<script>
    nusselt.load().then(library => {{
        const corners = Float32Array.of(-1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1);
        const lights = library.prepare("PolygonProjectedSolidAngle", 1, corners);
        window.measure = lights.measure()[0];
        window.density = lights.sample(Float32Array.of(0.25, 0.5)).pdf[0];
        document.documentElement.dataset.state = "ready";
    }}).catch(error => document.documentElement.dataset.state = String(error));
</script>
</html>
"""


def main():
    package, folder = (pathlib.Path(path).resolve() for path in sys.argv[1:])
    page = folder / "page.html"
    page.write_text(PAGE.format(script=(package / "nusselt.global.js").as_uri()))
    browser = Browser()
    try:
        state = browser.open(page)
        measure, density = browser.script("return [window.measure, window.density]")
        messages = browser.messages()
    finally:
        browser.quit()
    assert state == "ready", state
    assert not messages, messages
    # The form factor of a square of side 2 at distance 1, in parallel planes (Nusselt's analog).
    expected = 2 * math.sqrt(2) * math.atan(1 / math.sqrt(2))
    assert abs(measure - expected) < 1e-6, f"{measure} in place of {expected}"
    assert density > 0, density
    print(f"{measure} sr")


if __name__ == "__main__":
    main()
