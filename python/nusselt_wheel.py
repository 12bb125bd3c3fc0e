#!/usr/bin/env python3
"""Makes the wheel of the Python module: what pip calls (PEP 517), and `make python`.

Usage: python/nusselt_wheel.py FOLDER
Builds by CMake with what is installed; nothing is downloaded. Debian's interpreter shares the folder build/release with the
programs, other versions of Python have folders of their own.
"""
import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
DEBIAN = "/usr/bin/python3"


def version():
    return re.search(r"project\(nusselt VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def is_debian():
    """Whether modules for Debian's interpreter fit the one that runs this."""
    if not pathlib.Path(DEBIAN).exists():
        return False
    suffix = "import sysconfig; print(sysconfig.get_config_var('EXT_SUFFIX'))"
    found = subprocess.run([DEBIAN, "-c", suffix], capture_output=True, text=True, check=False)
    return found.stdout.strip() == sysconfig.get_config_var("EXT_SUFFIX")


def build(given):
    """Builds the package, in a given folder or the usual one. Returns the folder of the package."""
    options = []
    if given is not None:
        folder = pathlib.Path(given)
    elif is_debian():
        folder = ROOT / "build/release"
    else:
        folder = ROOT / f"build/python-{sysconfig.get_python_version()}"
        options = [f"-DPython_EXECUTABLE={sys.executable}"]
    # The preset would ask for the tests, too: an existing folder keeps what it was configured for.
    if not (folder / "build.ninja").exists():
        options += ["--preset", "release", "-B", folder, "-DNUSSELT_BUILD_TESTS=OFF"]
    else:
        options.append(folder)
    if not (folder / "python/nusselt").is_dir():
        subprocess.run(["cmake", "-DNUSSELT_BUILD_PYTHON=ON", *options], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "nusselt_python"], cwd=ROOT, check=True)
    return folder / "python/nusselt"


def metadata():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version()}",
             f"Summary: {project['description']}", f"Requires-Python: {project['requires-python']}",
             *(f"Requires-Dist: {package}" for package in project["dependencies"]),
             "Description-Content-Type: text/markdown", "", (ROOT / project["readme"]).read_text()]
    return "\n".join(lines)


def package_files(package):
    """The files of the package by name: its sources, the table of techniques and the module for this interpreter. A build
    folder may have modules for others, and sources that are no longer there."""
    names = [path.name for path in (ROOT / "python/nusselt").iterdir() if path.suffix in (".py", ".pyi")]
    names += ["py.typed", "techniques.py", f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"]
    return {f"nusselt/{name}": (package / name).read_bytes() for name in sorted(names)}


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel into a folder. Returns its name. config_settings: build-folder, for one that exists already."""
    package = build((config_settings or {}).get("build-folder"))
    info = f"nusselt-{version()}.dist-info"
    files = package_files(package)
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: nusselt\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record.append(f"{name},sha256={digest},{len(content)}\n")
    files[f"{info}/RECORD"] = ("".join(record) + f"{info}/RECORD,,\n").encode()
    name = f"nusselt-{version()}-{tag()}.whl"
    pathlib.Path(wheel_directory).mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for file, content in files.items():
            member = zipfile.ZipInfo(file, date_time=(1980, 1, 1, 0, 0, 0))  # the same wheel at any time
            member.compress_type = zipfile.ZIP_DEFLATED
            member.external_attr = 0o644 << 16
            archive.writestr(member, content)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """pip asks for it only to publish: the sources are the checkout."""
    raise NotImplementedError("there are no source distributions; install from a checkout of the repository")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(pathlib.Path(sys.argv[1]) / build_wheel(sys.argv[1]))
