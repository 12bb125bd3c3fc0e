#!/usr/bin/env python3
"""Tests that site/build.py finds mistakes of pages, and shows what pages link to."""
import argparse
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "site"))
sys.dont_write_bytecode = True
import build


class BuildTest(unittest.TestCase):
    """Each test has a repository of its own, with a page."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        site, build.ROOT, build.SITE = build.SITE, self.root, self.root / "site"
        self.addCleanup(setattr, build, "SITE", site)
        build.SITE.mkdir()
        subprocess.run(["git", "init", "--quiet", folder.name], check=True)
        for name in ("template.html", "site.css", "site.js", "formulas.js"):
            (build.SITE / name).write_bytes((site / name).read_bytes())
        (build.SITE / "contents.json").write_text('[{"part": "Start", "pages": ["README.md"]}]')

    def made(self, text, **folders):
        (self.root / "README.md").write_text(f"# Title\n\n{text}\n")
        options = {"out": self.root / "out", "report": None, "pictures": None, "live": None, **folders}
        build.build(argparse.Namespace(**options))
        return (self.root / "out/index.html").read_text()

    def refuses(self, text, message):
        with self.assertRaisesRegex(build.SiteError, message):
            self.made(text)

    def test_missing_files_headings_and_pages(self):
        self.refuses("[a](nowhere.h)", "README.md: the file nowhere.h is missing")
        self.refuses("[a](../outside.h)", "the file ../outside.h is missing")
        self.refuses("[a](#nothing)", "README.md has no heading #nothing")
        (self.root / "OTHER.md").write_text("# Other\n")
        self.refuses("", "does not name OTHER.md")

    def test_formulas_that_are_not_valid(self):
        self.refuses(r"$\nothing{1}$", "a formula is not valid")
        self.refuses("$$ a\n+ b $$", "Markdown breaks a formula")
        self.assertNotIn("\\frac{1}{2} </span>", self.made(r"$\frac{1}{2}$"))
        self.assertIn("katex", self.made(r"$\frac{1}{2}$"))

    def test_linked_files_and_folders_become_pages(self):
        (self.root / "code").mkdir()
        (self.root / "code/a.h").write_text("#include <b> & c")
        (self.root / ".gitignore").write_text("*.log\n")
        (self.root / "code/private.log").write_bytes(b"\xff")
        body = self.made('[a](code/a.h) [folder](code) [far](https://example.org/x) `<a href="b.h">`')
        for link in ("code/a.h.html", "code/index.html", "https://example.org/x"):
            self.assertIn(f'href="{link}"', body)
        self.assertIn("#include &lt;b&gt; &amp; c", (self.root / "out/code/a.h.html").read_text())
        listed = (self.root / "out/code/index.html").read_text()
        self.assertIn('href="a.h.html"', listed)
        self.assertNotIn("private", listed)
        self.refuses("[a](code/private.log)", "code/private.log is linked to, but is not a text")

    def test_only_sites_are_replaced(self):
        (self.root / "out").mkdir()
        (self.root / "out/mine").write_text("")
        self.refuses("", "is neither an empty folder nor a site")
        (self.root / "out/mine").unlink()
        self.made("first")
        self.assertIn("second", self.made("second"))
        self.assertTrue((self.root / "out/fonts/LICENCE-KaTeX.txt").exists())
        self.refuses("[a](nowhere.h)", "is missing")
        self.assertIn("second", (self.root / "out/index.html").read_text())

    def test_sources_are_kept(self):
        for folder in (build.SITE, build.SITE / "new", self.root, self.root.parent):
            with self.assertRaisesRegex(build.SiteError, "has the sources of the site"):
                self.made("", out=folder)
        self.assertTrue((build.SITE / "site.js").exists())

    def test_pages_of_folders_are_in_the_contents(self):
        (self.root / "report").mkdir()
        (self.root / "report/index.html").write_text("<p>numbers</p>")
        self.assertNotIn("report/index.html", self.made(""))
        self.assertIn("report/index.html", self.made("", report=self.root / "report"))
        self.assertEqual((self.root / "out/report/index.html").read_text(), "<p>numbers</p>")

    def test_scenes_of_the_gallery(self):
        (self.root / "scenes").mkdir()
        (self.root / "scenes/lamp.pbrt").write_text("# A lamp & a wall.\n# Units: metres.\nFilm\n")
        (build.SITE / "gallery.txt").write_text("lamp\n")
        with self.assertRaises(OSError):
            self.made("", pictures=self.root / "pictures")
        (self.root / "pictures").mkdir()
        (self.root / "pictures/lamp.png").write_bytes(b"picture")
        (self.root / "pictures/about.txt").write_text("Two samples.\n")
        self.made("", pictures=self.root / "pictures")
        gallery = (self.root / "out/gallery.html").read_text()
        self.assertIn('alt="A lamp &amp; a wall."', gallery)
        self.assertIn("<p>Two samples.</p>", gallery)
        self.assertIn('href="scenes/lamp.pbrt.html"', gallery)


if __name__ == "__main__":
    unittest.main()
