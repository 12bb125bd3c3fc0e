#!/usr/bin/env python3
"""A report with invented numbers, for tests and to look at. Needs only the standard library of Python.

Usage: tests/report/sample_report.py OUTPUT.html [REFERENCE.pfm VARIANT.pfm...]
With images (`nusselt convert IN.exr OUT.pfm`), the report also has an experiment that shows them.
"""
import base64
import json
import math
import pathlib
import random
import struct
import sys
import zlib

PAGE = pathlib.Path(__file__).resolve().parents[2] / "lab/report/page"
HOSTILE = "</script><img src=x onerror=\"document.title='broken'\"> & <b>bold</b> @SCRIPT@"


def page_with(text):
    """The page around a JSON text, which may be damaged."""
    parts = {
        "@STYLE@": (PAGE / "page.css").read_text(),
        "@SCRIPT@": "\n".join(file.read_text() for file in sorted(PAGE.glob("*.js"))),
        # Without `<`, nothing in the text can end its element.
        "@DATA@": text.replace("<", "\\u003c"),
    }
    template = (PAGE / "page.html").read_text()
    # Once from front to back: texts of the report may look like the marks.
    for mark in parts:
        assert template.count(mark) == 1, mark
    html = ""
    while template:
        found = min((mark for mark in parts if mark in template), key=template.index, default=None)
        if found is None:
            return html + template
        before, template = template.split(found, 1)
        html += before + parts[found]
    return html


def png(width, height, rows):
    """A PNG of 8-bit RGB from bytes for each row."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows), 6)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def rgbe(pixel):
    """Mantissas and the shared exponent of a pixel: values are (m + 0.5) 2^(e - 136); pixels.js has the convention."""
    if not all(map(math.isfinite, pixel)):
        return (0, 0, 0), 255
    largest = max(pixel)
    if largest <= 0:
        return (0, 0, 0), 0
    exponent = math.frexp(largest)[1] + 128
    if exponent < 1:
        return (0, 0, 0), 0
    exponent = min(exponent, 254)
    scale = math.ldexp(1, 136 - exponent)
    return tuple(min(255, int(max(0, value) * scale)) for value in pixel), exponent


def decoded(pixel):
    """What the page has to make of a pixel."""
    mantissas, exponent = rgbe(pixel)
    if exponent == 255:
        return [math.nan] * 3
    return [(m + 0.5) * math.ldexp(1, exponent - 136) if exponent else 0.0 for m in mantissas]


def image(label, role, rows, metrics=None):
    """An image of the report from rows of linear pixels."""
    width, height = len(rows[0]), len(rows)
    codes = [[rgbe(pixel) for pixel in row] for row in rows]
    mantissas = [bytes(value for m, _ in row for value in m) for row in codes]
    exponents = [bytes(value for _, e in row for value in (e, e, e)) for row in codes]
    data = base64.b64encode(png(width, 2 * height, mantissas + exponents)).decode()
    return {"label": label, "role": role, "width": width, "height": height, "encoding": "rgbe_stacked",
            "data": "data:image/png;base64," + data, "metrics": metrics or {}}


def gradient(width=96, height=64):
    """A picture of known pixels: red rises to the right, green falls downwards, blue is constant."""
    return [[(0.02 + x / width, 0.9 - 0.8 * y / height, 0.25) for x in range(width)] for y in range(height)]


def changed(rows, seed, strength):
    """The picture with noise, and pixels that tests know: black, not finite, and exactly a quarter brighter."""
    noise = random.Random(seed)
    result = [[tuple(max(0.0, value * (1 + noise.gauss(0, strength))) for value in pixel) for pixel in row] for row in rows]
    result[5][7] = (0.0, 0.0, 0.0)
    result[6][7] = (math.nan, 1.0, 1.0)
    result[7][7] = tuple(1.25 * value for value in rows[7][7])
    return result


def srgb_picture():
    """Bytes that must reach the screen as they are."""
    rows = [bytes(value for x in range(64) for value in (4 * x, 255 - 4 * x, y * 8)) for y in range(32)]
    data = base64.b64encode(png(64, 32, rows)).decode()
    return {"label": "encoded bytes", "role": "variant", "width": 64, "height": 32, "encoding": "srgb",
            "data": "data:image/png;base64," + data, "metrics": {"rmse": None}}


MACHINE = {"processor": "Example processor at 3 GHz", "instruction_set": "avx2", "cores": 8, "system": "Debian 12"}
INSETS = [{"name": "corner", "left": 0, "top": 0, "right": 0.25, "bottom": 0.25},
          {"name": "middle", "left": 0.5, "top": 0.375, "right": 0.75, "bottom": 0.625}]


def experiment(name, **others):
    return {"name": name, "source": "Example 2020, figure 3", "description": "Noise of three techniques.\n\nAll take one "
            "sample per pixel.", "effort": "quick", "command": f"nusselt-lab reproduce {name} --effort quick -o out",
            "version": "1.4.0-12-gabc1234", "machine": MACHINE, "date": "2026-11-20T10:20:30Z", "seconds": 81.4,
            "settings": {"spp": 1, "resolution": "96x64", "seed": 0}, "tables": [], "expectations": [], "images": [],
            "insets": [], "plots": [], "measured": []} | others


def noise_experiment():
    picture = gradient()
    counts = [2**i for i in range(11)]
    curve = [0.5 / count**0.5 for count in counts]
    fast = [0.45 / count**0.8 for count in counts]
    return experiment(
        "noise",
        images=[image("reference", "reference", picture),
                image("area", "variant", changed(picture, 1, 0.4), {"rmse": 0.930703835, "flip": 0.14903981}),
                image("solid angle", "variant", changed(picture, 2, 0.15), {"rmse": 0.728225532, "flip": 0.0537933604}),
                image("projected solid angle", "variant", changed(picture, 3, 0.05),
                      {"rmse": 0.7269912, "flip": None, "relative_rmse": 0.0285309927})],
        insets=INSETS,
        expectations=[{"text": "RMSE falls: area, solid angle, projected solid angle", "state": "holds"},
                      {"text": "RMSE of projected solid angle is at most 0.7", "state": "fails", "reason": "It is 0.727."},
                      {"text": "the mean is that of the reference", "state": "not_evaluated",
                       "reason": "One frame has no standard deviation."}],
        tables=[{"name": "errors_of_images",
                 "columns": [{"name": "technique"}, {"name": "rmse", "unit": "radiance"}, {"name": "time_per_sample", "unit": "ns"},
                             {"name": "rays"}],
                 "rows": [["area", 0.930703835, 12.3456, 61440], ["solid angle", 0.728225532, None, 61440],
                          ["projected solid angle", 1.23456e-5, 1234567.8, 61440]]}],
        plots=[{"title": "Error over samples", "x_label": "samples per pixel", "y_label": "RMSE", "x_scale": "log",
                "y_scale": "log",
                "series": [{"label": "independent", "x": counts, "y": curve, "low": [0.8 * y for y in curve],
                            "high": [1.25 * y for y in curve]},
                           {"label": "stratified", "x": counts, "y": fast[:5] + [None] + fast[6:],
                            "low": [0] + [0.8 * y for y in fast[1:]], "high": [1.3 * y for y in fast]}]},
               {"title": "Time over vertices", "x_label": "vertices", "y_label": "time [ns]", "x_scale": "linear",
                "y_scale": "linear", "series": [{"label": f"technique {i}", "x": [3, 4, 5, 6, 7, 8],
                                                 "y": [10 + i * n for n in range(3, 9)]} for i in range(3)]},
               {"title": "A drawing", "svg": "<svg xmlns='http://www.w3.org/2000/svg' width='300' height='80' viewBox='0 0 300 80' "
                "onload='document.title=\"broken\"'><script>document.title = 'broken'</script><rect width='100%' "
                "height='100%' fill='#eef'/><text x='20' y='45'>drawn elsewhere</text><image href='x.png'/></svg>"}],
        measured=[{"item": "a-figure-3", "quantity": "RMSE of area", "value": 0.930703835},
                  {"item": "a-figure-3", "quantity": "time", "value": 12.3, "unit": "ns"},
                  {"item": "a-figure-3", "quantity": "speed-up", "value": 2.13},
                  {"item": "a-table-1", "quantity": "bias", "value": None}])


def hostile_experiment():
    """Texts that would break a page that takes them for HTML, tables without numbers, and an image that is damaged."""
    broken = image("damaged", "variant", gradient(8, 8))
    broken["data"] = "data:image/png;base64,AAAA"
    return experiment(
        HOSTILE, source=HOSTILE, description=HOSTILE, command=f"nusselt-lab reproduce '{HOSTILE}'", seconds=None,
        settings={HOSTILE: HOSTILE}, machine={"processor": HOSTILE},
        tables=[{"name": HOSTILE, "columns": [{"name": HOSTILE, "unit": HOSTILE}, {"name": "nothing"}],
                 "rows": [[HOSTILE, None], [HOSTILE, None]]},
                {"name": "long", "columns": [{"name": "n"}, {"name": "square"}, {"name": "even"}],
                 "rows": [[n, n * n, n % 2 == 0] for n in range(60)]}],
        expectations=[{"text": HOSTILE, "state": "passed", "reason": HOSTILE}],
        images=[srgb_picture(), broken], insets=[{"name": HOSTILE, "left": 0, "top": 0, "right": 0.5, "bottom": 0.5}],
        plots=[{"title": HOSTILE, "x_label": HOSTILE, "y_label": HOSTILE, "x_scale": "log", "y_scale": "linear",
                "series": [{"label": HOSTILE, "x": [1, 10, 100], "y": [None, 2, 3]}]},
               {"title": "no drawing", "svg": "<p>"}])


def calm_experiments():
    """One whose expectations hold, and one of which a later quick run found otherwise."""
    holds = [{"text": "the mean is that of the reference", "state": "holds"}]
    later = {"date": "2026-11-21T10:20:30Z", "version": "1.5.0",
             "expectations": [{"text": "the mean is that of the reference", "state": "fails"}]}
    return [experiment("calm", expectations=holds), experiment("late", effort="full", expectations=holds, later=later)]


def report():
    items = [
        {"id": "a-figure-1", "item": "Figure 1", "shows": "a mean", "kind": "figure", "published": [], "by": ["calm"]},
        {"id": "a-figure-2", "item": "Figure 2", "shows": "a mean elsewhere", "kind": "figure", "published": [], "by": ["calm"],
         "scene": "own", "why": "The scene is lost."},
        {"id": "a-figure-3", "item": "Figure 3", "shows": "noise of three techniques at equal sample counts", "kind": "figure",
         "published": [{"quantity": "RMSE of area", "value": 0.9}, {"quantity": "time", "value": 0.0125, "unit": "µs"},
                       {"quantity": "rank", "value": "first"}], "by": ["noise", "slow"], "scene": "paper"},
        {"id": "a-table-1", "item": "Table 1", "shows": "bias of the clamped estimate", "kind": "table",
         "published": [{"quantity": "bias", "value": 0.01}], "by": ["noise"], "scene": "own",
         "why": "The scene of the paper was never published."},
        {"id": "a-section-5", "item": "Section 5", "shows": "the method works for textured lights", "kind": "statement",
         "published": [], "by": [], "not_applicable": "Lights have no textures here."},
        {"id": "a-figure-9", "item": "Figure 9", "shows": "animated lights", "kind": "figure", "by": [],
         "missing": "There is no experiment with motion yet."},
        {"id": "a-figure-4", "item": "Figure 4", "shows": "a mean of today", "kind": "figure", "published": [], "by": ["late"]},
        {"id": "a-section-6", "item": "Section 6", "shows": "a mean and more", "kind": "statement", "published": [],
         "by": ["calm"], "lacks": "Nobody measures more."},
        {"id": "a-figure-10", "item": "Figure 10", "shows": "a large scene", "kind": "figure", "published": [], "by": ["slow"]},
    ]
    hostile = [{"id": HOSTILE, "item": HOSTILE, "shows": HOSTILE, "kind": "statement", "by": [HOSTILE], "scene": "own",
                "why": HOSTILE, "published": [{"quantity": HOSTILE, "value": HOSTILE, "unit": HOSTILE}]}]
    return {"title": "Reproduction of published results", "generated": "2026-11-26T09:00:00Z",
            "papers": [{"key": "example2020", "title": "Sampling of lights by an example", "authors": "A. Author and B. Author",
                        "year": 2020, "venue": "Journal of Examples", "items": items},
                       {"key": HOSTILE, "title": HOSTILE, "authors": HOSTILE, "year": 2021, "venue": HOSTILE, "items": hostile}],
            "experiments": [noise_experiment(), hostile_experiment(), *calm_experiments()],
            "not_run": [{"name": "slow", "reason": "It needs --effort full."}, {"name": HOSTILE, "reason": HOSTILE}]}


def read_pfm(file):
    """Rows of pixels from the top."""
    kind, size, scale, data = pathlib.Path(file).read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind == b"PF", "only images with three channels"
    values = struct.unpack(("<" if float(scale) < 0 else ">") + f"{3 * width * height}f", data)
    pixels = [values[i:i + 3] for i in range(0, len(values), 3)]
    return [pixels[width * y:width * (y + 1)] for y in reversed(range(height))]


def picture_experiment(files):
    images = [image(pathlib.Path(file).stem.replace("_", " "), "variant" if i else "reference", read_pfm(file))
              for i, file in enumerate(files)]
    insets = [{"name": "left", "left": 0.2, "top": 0.55, "right": 0.3, "bottom": 0.73},
              {"name": "right", "left": 0.55, "top": 0.45, "right": 0.65, "bottom": 0.63}]
    return experiment("pictures", description="Images that were given on the command line.", images=images, insets=insets)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sample = report()
    if sys.argv[2:]:
        sample["experiments"].insert(0, picture_experiment(sys.argv[2:]))
    pathlib.Path(sys.argv[1]).write_text(page_with(json.dumps(sample)))
