#!/usr/bin/env python3
"""Makes a static site of the documentation, which works without a network and from a disk.

Usage: site/build.py OUT [--pictures FOLDER] [--report FOLDER] [--live FOLDER]
  OUT         the folder of the site: new, empty, or of an earlier site, which the new one replaces
  --pictures  images of the scenes of site/gallery.txt, NAME.png, and how they were made, about.txt
  --report    a folder of `nusselt-lab reproduce`
  --live      the folder of the live page
Without a folder, the site has no such page. Needs pandoc, nodejs and Debian's libjs-katex.

Pages are the Markdown files of the root, docs/ and shaders/. Each is named in site/contents.json. Other files that they link
to become pages that show them; folders become lists. A link to a file or a heading that is missing is an error.
"""
import argparse
import concurrent.futures
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SITE = pathlib.Path(__file__).resolve().parent
ROOT = SITE.parent
KATEX = pathlib.Path("/usr/share/javascript/katex")
IMAGES = {".png", ".svg", ".jpg"}
KATEX_LICENCE = pathlib.Path("/usr/share/doc/libjs-katex/copyright")
LARGEST_SOURCE = 400_000  # bytes of a file that becomes a page
MARK = ".made-by-site-build"  # tells folders of sites from those of sources


class SiteError(Exception):
    """A fault of the documentation, for the person who writes it."""


def markdown_files():
    return {str(path.relative_to(ROOT)) for pattern in ("*.md", "docs/**/*.md", "shaders/**/*.md")
            for path in ROOT.glob(pattern)}


def contents():
    """[(part, [page, ...]), ...], with each page once."""
    known = markdown_files()
    parts, named = [], set()
    for part in json.loads((SITE / "contents.json").read_text()):
        pages = []
        for pattern in part["pages"]:
            matching = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob(pattern))
            if not matching:
                raise SiteError(f"site/contents.json: there is no page '{pattern}'")
            # The overview of a folder comes first.
            pages += sorted(matching, key=lambda page: not page.endswith("README.md"))
        parts.append((part["part"], pages))
        named.update(pages)
    if known != named:
        raise SiteError(f"site/contents.json does not name {', '.join(sorted(known - named))}")
    return parts


def sources():
    """The files of the repository, without what editors and builds leave in its folders."""
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            capture_output=True, text=True)
    if listed.returncode != 0:
        raise SiteError(f"git does not list the files of {ROOT}: {listed.stderr.strip()}")
    return set(listed.stdout.split("\0"))


def address_of(path):
    """The address of the page that shows a file or a folder of the repository."""
    if path.endswith("README.md"):
        return path.removesuffix("README.md") + "index.html"
    if path.endswith(".md"):
        return path.removesuffix("md") + "html"
    if (ROOT / path).is_dir():
        return path + "/index.html"
    return path if pathlib.Path(path).suffix in IMAGES else path + ".html"


def title_of(page):
    return re.match(r"# +(.*)", (ROOT / page).read_text()).group(1)


def converted(page):
    """The body of a page in HTML, with formulas in TeX."""
    done = subprocess.run(["pandoc", "--from", "gfm+tex_math_dollars", "--to", "html5", "--mathjax", "--wrap", "preserve",
                           str(ROOT / page)], capture_output=True, text=True, check=True)
    return re.sub(r"(<table.*?</table>)", r'<div class="wide">\1</div>', done.stdout, flags=re.DOTALL)


FORMULA = re.compile(r'<span class="math (inline|display)">\\[(\[](.*?)\\[)\]]</span>', re.DOTALL)


def typeset(bodies):
    """Bodies with formulas in HTML."""
    formulas = [{"tex": html.unescape(tex), "display": kind == "display"}
                for body in bodies for kind, tex in FORMULA.findall(body)]
    done = subprocess.run(["node", str(SITE / "formulas.js"), str(KATEX / "katex.min.js")],
                          input=json.dumps(formulas), capture_output=True, text=True)
    if done.returncode != 0:
        raise SiteError(f"a formula is not valid: {done.stderr.strip()}")
    for body in bodies:
        rest = re.search(r"\$\$.*", re.sub(r"<code.*?</code>", "", body, flags=re.DOTALL))
        if rest:
            raise SiteError(f"Markdown breaks a formula, as a line of it begins like a list: {rest.group(0)}")
    ready = iter(json.loads(done.stdout))
    return [FORMULA.sub(lambda _: next(ready), body) for body in bodies]


def plain(markup):
    markup = re.sub(r'<span class="katex-mathml">.*?</math></span>', " ", markup, flags=re.DOTALL)
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", markup)).split())


class Site:
    def __init__(self, out):
        self.out = out
        self.parts = contents()
        self.titles = {page: title_of(page) for _, pages in self.parts for page in pages}
        self.extra = []  # (address, title) of pages that are not documentation
        self.template = (SITE / "template.html").read_text()
        self.sections = []  # [address, page, heading, text] for the search
        self.shown = set()  # files and folders of the repository that have pages
        self.anchors = {}  # of each page
        self.links = []  # (page, path of the target, anchor)
        self.sources = sources()

    def write(self, address, title, body):
        root = "../" * address.count("/")
        page = self.template
        for name, value in (("title", html.escape(title)), ("root", root), ("contents", self.navigation(address, root)),
                            ("body", body)):
            page = page.replace(f"@{name}@", value)
        self.put(address, page)

    def put(self, address, text):
        file = self.out / address
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def navigation(self, current, root):
        def item(address, title):
            mark = ' aria-current="page"' if address == current else ""
            return f'<li><a href="{root}{address}"{mark}>{html.escape(title)}</a></li>'

        lists = [("", self.extra)] if self.extra else []
        lists += [(part, [(address_of(page), self.titles[page]) for page in pages]) for part, pages in self.parts]
        return "\n".join((f"<h2>{part}</h2>\n" if part else "") + "<ul>" +
                         "".join(item(*entry) for entry in entries) + "</ul>" for part, entries in lists)

    def add_page(self, page, body):
        self.anchors[page] = set(re.findall(r'id="([^"]*)"', body))
        self.write(address_of(page), self.titles[page], self.relinked(page, body))
        heading, anchor = self.titles[page], ""
        for part in filter(str.strip, re.split(r"(?=<h[123][ >])", body)):
            match = re.match(r'<h[123](?: id="([^"]*)")?[^>]*>(.*?)</h', part, re.DOTALL)
            if match:
                anchor, heading = match.group(1) or "", plain(match.group(2))
            self.sections.append([address_of(page) + (f"#{anchor}" if anchor else ""), self.titles[page], heading,
                                  plain(part)])

    def relinked(self, page, body):
        """A body whose links to files of the repository lead to pages of the site."""
        folder = os.path.dirname(page)

        def replaced(match):
            target = html.unescape(match.group(2))
            if "://" in target or target.startswith(("#", "mailto:", "data:")):
                if target.startswith("#"):
                    self.links.append((page, page, target[1:]))
                return match.group(0)
            path, _, anchor = target.partition("#")
            path = os.path.normpath(os.path.join(folder, path))
            if not (ROOT / path).exists() or path.startswith(".."):
                raise SiteError(f"{page}: the file {target} is missing")
            if (ROOT / path).is_dir() and (ROOT / path / "README.md").exists():
                path = os.path.join(path, "README.md")
            self.links.append((page, path, anchor))
            address = os.path.relpath(address_of(path), folder or ".") + (f"#{anchor}" if anchor else "")
            return f'{match.group(1)}="{html.escape(address)}"'

        return re.sub(r'(<(?:a|img)\b[^>]*? (?:href|src))="([^"]*)"', replaced, body)

    def show(self, path):
        """Makes the page of a file or folder, unless it has one."""
        if path in self.shown or path.endswith(".md"):
            return
        self.shown.add(path)
        file = ROOT / path
        if file.suffix in IMAGES:
            (self.out / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, self.out / path)
        elif file.is_dir():
            files = sorted(f for f in file.iterdir() if f"{path}/{f.name}" in self.sources and f.suffix != ".md")
            for f in files:
                self.show(f"{path}/{f.name}")
            items = "".join(f'<li><a href="{html.escape(os.path.basename(address_of(f"{path}/{f.name}")))}">'
                            f"{html.escape(f.name)}</a></li>" for f in files)
            self.write(address_of(path), path, f"<h1>{html.escape(path)}</h1>\n<ul>{items}</ul>")
        else:
            if file.stat().st_size > LARGEST_SOURCE:
                raise SiteError(f"{path} is linked to, but too large for a page")
            try:
                text = file.read_text()
            except UnicodeDecodeError:
                raise SiteError(f"{path} is linked to, but is not a text") from None
            self.write(address_of(path), path, f'<h1>{html.escape(path)}</h1>\n<pre class="source">{html.escape(text)}</pre>')

    def check_anchors(self):
        for page, target, anchor in self.links:
            if anchor and target.endswith(".md") and anchor not in self.anchors[target]:
                raise SiteError(f"{page}: {target} has no heading #{anchor}")

    def add_gallery(self, pictures):
        items = []
        for name in (SITE / "gallery.txt").read_text().split():
            scene = f"scenes/{name}.pbrt"
            about = re.match(r"(?:# ?.*\n)+", (ROOT / scene).read_text()).group(0).replace("# ", "").replace("\n", " ")
            about = about.split(" Units:")[0].strip()
            self.show(scene)
            target = f"gallery/{name}.png"
            (self.out / target).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(pictures / f"{name}.png", self.out / target)
            items.append(f'<figure><a href="{target}"><img src="{target}" alt="{html.escape(about)}" loading="lazy"></a>'
                         f'<figcaption>{html.escape(about)} <a href="{address_of(scene)}">The scene</a></figcaption></figure>')
        about = html.escape((pictures / "about.txt").read_text().strip())
        self.write("gallery.html", "Gallery", f"<h1>Gallery</h1>\n<p>{about}</p>\n" + "\n".join(items))


def check_is_replaceable(out):
    """Whether a folder may be replaced by a site: no sources, and nobody else's files."""
    place = out.resolve()
    if ROOT.is_relative_to(place) or place.is_relative_to(SITE):
        raise SiteError(f"'{out}' has the sources of the site")
    if out.exists() and (not out.is_dir() or any(out.iterdir()) and not (out / MARK).exists()):
        raise SiteError(f"'{out}' is neither an empty folder nor a site")


def build(options):
    check_is_replaceable(options.out)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    # A mistake of a page leaves the earlier site as it is.
    with tempfile.TemporaryDirectory(dir=options.out.parent, prefix=f".{options.out.name}-") as folder:
        made = pathlib.Path(folder) / "site"
        make(options, made)
        shutil.rmtree(options.out, ignore_errors=True)
        made.rename(options.out)


def make(options, out):
    site = Site(out)
    for folder, address, title in ((options.live, "live/index.html", "Live in this browser"),
                                   (options.pictures, "gallery.html", "Gallery"),
                                   (options.report, "report/index.html", "The report of this version")):
        if folder:
            site.extra.append((address, title))
    out.mkdir()
    (out / MARK).touch()
    for name in ("site.css", "site.js"):
        shutil.copy(SITE / name, out)
    pages = [page for _, pages in site.parts for page in pages]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        bodies = typeset(list(pool.map(converted, pages)))
    for page, body in zip(pages, bodies):
        site.add_page(page, body)
    site.check_anchors()
    for _, target, _ in site.links:
        site.show(target)
    if options.pictures:
        site.add_gallery(options.pictures)
    for folder, name in ((options.report, "report"), (options.live, "live")):
        if folder:
            shutil.copytree(folder, out / name)
    site.put("sections.js", f"const sections = {json.dumps(site.sections, ensure_ascii=False)};\n")
    shutil.copy(KATEX / "katex.min.css", out / "katex.css")
    (out / "fonts").mkdir()
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, out / "fonts")
    shutil.copy(KATEX_LICENCE, out / "fonts/LICENCE-KaTeX.txt")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    for name in ("--pictures", "--report", "--live"):
        parser.add_argument(name, type=pathlib.Path, metavar="FOLDER")
    options = parser.parse_args()
    try:
        build(options)
    except (SiteError, OSError) as error:
        sys.exit(f"site/build.py: {error}")


if __name__ == "__main__":
    main()
