#!/usr/bin/env python3
"""Compares images of the live page with those of the C++ renderer, and its techniques with each other.

Usage: tests/page/images_test.py NUSSELT [NAME_OF_TEST...]
What it needs, and how it ends without: see live_page.py.
"""
import math
import os
import struct
import subprocess
import sys
import unittest
import pathlib

from live_page import HEIGHT, LINK, ROOT, WIDTH, LivePageTest, page_html
from pictures import smooth_pixels

BLOCK = 10  # pixels in a row of a block
SEEDS = 4   # pictures of each program, which differ by noise alone
# The Vulkan renderer on a processor compiles its shaders for each picture, which takes most of its time.
VULKAN_SEEDS = 2
# Standard deviations that a normal variable exceeds with a probability of 1e-6.
Z = 4.75
# The mean of a technique that is biased, over that of one that is not: within this difference from 1.
MOST_BIAS = 0.1


def read_pfm(file):
    """All numbers of an image with three channels, row by row from the top."""
    kind, size, scale, data = pathlib.Path(file).read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind == b"PF"
    values = struct.unpack(("<" if float(scale) < 0 else ">") + f"{3 * width * height}f", data)
    return [value for y in reversed(range(height)) for value in values[3 * width * y:3 * width * (y + 1)]]


def block_means(image, mask):
    """Means of the channels over blocks of what a mask leaves; None for blocks of which it leaves little."""
    columns = WIDTH // BLOCK
    sums = [0.0] * (columns * (HEIGHT // BLOCK))
    counts = [0] * len(sums)
    for i, counted in enumerate(mask):
        if counted:
            block = i // WIDTH // BLOCK * columns + i % WIDTH // BLOCK
            sums[block] += sum(image[3 * i:3 * i + 3]) / 3
            counts[block] += 1
    return [total / count if count >= BLOCK**2 // 4 else None for total, count in zip(sums, counts)]


def mean(values):
    return sum(values) / len(values)


def mean_image(images):
    return [mean(values) for values in zip(*images)]


def variance_of_mean(values):
    center = mean(values)
    return sum((value - center)**2 for value in values) / (len(values) - 1) / len(values)


class Comparison:
    """Two programs by blocks of pictures, several of each, with independent noise.

    Blocks are divided by their brightness, so that dark ones count. The squared differences of means over the sum of
    the variances of both, which the pictures of each program tell, has the F distribution if the programs agree: with
    as many degrees of freedom as blocks for differences, and more for variances: one less than pictures of each program.
    Blocks and programs with different noise count as fewer ones, after Satterthwaite. The logarithm is nearly normal
    (Fisher), and its deviation z in standard deviations is at most Z."""

    def __init__(self, ours, theirs):
        mask = smooth_pixels(mean_image(theirs), WIDTH, HEIGHT)
        rows = list(zip(*(zip(*(block_means(image, mask) for image in images)) for images in (ours, theirs))))
        rows = [(ours, theirs) for ours, theirs in rows if None not in ours]
        scales = [mean(theirs) + 0.01 for _, theirs in rows]
        parts = [(variance_of_mean(ours) / scale**2, variance_of_mean(theirs) / scale**2)
                 for (ours, theirs), scale in zip(rows, scales)]
        variances = [sum(part) for part in parts]
        squares = [((mean(ours) - mean(theirs)) / scale)**2 for (ours, theirs), scale in zip(rows, scales)]
        self.ratio = sum(squares) / sum(variances)
        blocks = sum(variances)**2 / sum(variance**2 for variance in variances)
        of_each = [sum(part) for part in zip(*parts)]
        freedom = sum(of_each)**2 / sum(part**2 / (len(images) - 1) for part, images in zip(of_each, (ours, theirs)))
        self.z = math.log(self.ratio) / math.sqrt(2 / blocks * (1 + 1 / freedom))
        self.brightness = mean([mean(image) for image in ours]) / mean([mean(image) for image in theirs])

    def agrees(self):
        return self.z <= Z and abs(self.brightness - 1) < 0.01

    def __str__(self):
        return f"squared differences {self.ratio:.3} of noise, z {self.z:.3}; brightness {self.brightness:.4}"


class WithTheRenderers(LivePageTest):
    """Those for the processor and, once, for Vulkan."""

    def render(self, scene, spp, *options, seeds=SEEDS):
        images = []
        for seed in range(seeds):
            image = self.folder / "image.pfm"
            subprocess.run([NUSSELT, "render", ROOT / scene, "--resolution", f"{WIDTH}x{HEIGHT}", "--spp", str(spp),
                            "--pixel-center", "--seed", str(seed + 100), "-q", "-o", image, *options], check=True)
            images.append(read_pfm(image))
        return images

    def pictures(self, link, frames):
        """With other seeds, in one page: programs are compiled once."""
        images = []
        for seed in range(SEEDS):
            text = f"{LINK}&smooth=0&frames={frames}&seed={seed}&{link}"
            if seed == 0:
                self.open(text)
            else:
                self.go(text)
            images.append(self.image(frames))
        return images

    def check(self, link, frames, file, *options):
        theirs = self.render(file, 16, *options)
        comparison = Comparison(self.pictures(link, frames), theirs)
        self.assertTrue(comparison.agrees(), comparison)
        return theirs

    def test_area(self):
        """And what is wrong is found: without shadows, and with lights that are brighter by a fiftieth."""
        theirs = self.check("left-sampler=independent", 8, "web/scenes/floor.pbrt")
        self.refuses_mutants(theirs)

    def test_area_with_vulkan(self):
        """Shadows of the page against those of the renderer for GPUs, on the driver that needs none."""
        if os.environ.get("CI") != "true" and not list(pathlib.Path("/usr/share/vulkan/icd.d").glob("lvp_icd*")):
            self.skipTest("lavapipe is missing")
        theirs = self.render("web/scenes/floor.pbrt", 64, "--backend", "vulkan", "--device", "llvmpipe", "--technique", "area",
                             seeds=VULKAN_SEEDS)
        comparison = Comparison(self.pictures("left-sampler=independent", 8), theirs)
        self.assertTrue(comparison.agrees(), comparison)
        self.refuses_mutants(theirs)

    def refuses_mutants(self, theirs):
        for mutant in ("shadows=0", "lamps=0,0,0,0,0,1.02;0,0,0,0,0,1.02"):
            comparison = Comparison(self.pictures(f"left-sampler=independent&{mutant}", 8), theirs)
            self.assertFalse(comparison.agrees(), f"{mutant}: {comparison}")

    def test_cylinders(self):
        self.check("scene=room&thick=1&left-sampler=independent", 6, "scenes/room.pbrt")

    def test_projected_solid_angle(self):
        self.check("left=projected&left-sampler=independent", 4, "web/scenes/floor.pbrt")

    def test_two_techniques(self):
        self.check("left=projected_ltc&left-sampler=independent", 3, "web/scenes/floor.pbrt")


class Techniques(LivePageTest):
    """Each technique and heuristic by the mean of all pixels, whose noise is independent, from that of another one."""

    def options(self, name):
        return self.browser.script("return [...document.getElementById(arguments[0]).options].map(o => o.value)", name)

    def compare(self, image, expected):
        """The mean difference in standard deviations, and the ratio of means."""
        differences = [sum(image[i:i + 3]) - sum(expected[i:i + 3]) for i in range(0, len(image), 3)]
        return mean(differences) / math.sqrt(variance_of_mean(differences)), mean(image) / mean(expected)

    def test_means_agree(self):
        self.open(f"{LINK}&smooth=0&left=projected&frames=16&seed=1")
        expected = self.image(16)
        self.browser.click(self.find("#shadows"))
        unshadowed = self.image(16)
        self.assertGreater(self.compare(unshadowed, expected)[0], Z)
        self.go(f"{LINK}&smooth=0&frames=4")
        for technique in self.options("left"):
            with self.subTest(technique=technique):
                self.choose("#left", technique)
                image = self.image(4)
                z, ratio = self.compare(image, unshadowed if technique == "ltc_analytic" else expected)
                if "Biased" in self.find(".side .note").text:
                    self.assertAlmostEqual(1, ratio, delta=MOST_BIAS)
                else:
                    self.assertLess(abs(z), Z + 1, f"{ratio:.4}")
                # What is right for another light is not.
                self.assertGreater(abs(self.compare([1.05 * value for value in image], expected)[0]), Z)

    def test_heuristics_agree(self):
        self.open(f"{LINK}&smooth=0&left=projected&frames=16&seed=1")
        expected = self.image(16)
        self.go(f"{LINK}&smooth=0&frames=4&left=projected_ltc")
        images = []
        for heuristic in self.options("left-heuristic"):
            with self.subTest(heuristic=heuristic):
                self.choose("#left-heuristic", heuristic)
                image = self.image(4)
                self.assertNotIn(image, images)
                images.append(image)
                self.assertLess(abs(self.compare(image, expected)[0]), Z)

    def test_closed_form_takes_all_lights(self):
        """Several lights of each kind, with fewer vertices than there is room for: it has room for more."""
        file = self.folder / "two-panels.html"
        file.write_text(page_html((ROOT / "tests/page/two-panels.pbrt").read_text()))
        link = f"{LINK}&smooth=0&shadows=0&frames=8"
        self.open(f"{link}&left=projected", file)
        expected = self.image(8)
        self.choose("#left", "ltc_analytic")
        image = self.image(1)
        mask = smooth_pixels(expected, WIDTH, HEIGHT)
        blocks = [(a, b) for a, b in zip(block_means(image, mask), block_means(expected, mask)) if a is not None]
        self.assertLess(max(abs(a - b) / (b + 0.05) for a, b in blocks), 0.3)
        self.assertAlmostEqual(1, mean(image) / mean(expected), delta=0.05)


if __name__ == "__main__":
    NUSSELT = sys.argv[1]
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
