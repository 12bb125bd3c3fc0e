"""The types of the module for three.js in one file, with comments that editors show. Needs tsc."""
import pathlib
import re
import shutil
import subprocess
import tempfile

WEB = pathlib.Path(__file__).resolve().parent


def editors_comments(text):
    """Comments of `///` as those in stars, which alone tsc keeps and editors read."""
    def convert(match):
        lines = [line.strip()[4:] for line in match[0].strip().splitlines()]
        body = re.sub(r"\\(param|throws)", r"@\1", "\n".join(lines)).replace("\\return", "@returns")
        indent = re.match(" *", match[0])[0]
        return "".join(f"{indent}{line}\n" for line in ["/**", *(f" * {line}".rstrip() for line in body.splitlines()), " */"])

    return re.sub(r"(?:^ *///(?: .*)?\n)+", convert, text, flags=re.MULTILINE)


def public(text):
    """What users of classes see of them."""
    private = r"^ +private .*\n"
    return re.sub(rf"^( +)/\*\*\n(?:\1 \*.*\n)+{private}|{private}", "", text, flags=re.MULTILINE)


def declarations(module):
    """What tsc declares for a module of web/three, without the comment that it begins with.
    \\return the names that it imports from three.js, and the rest"""
    text = re.sub(r'^(import .* from "\..*|export \{\};)\n', "", module, flags=re.MULTILINE)
    imported = re.search(r'^import \{([^}]*)\} from "three";\n', text, flags=re.MULTILINE)
    return re.findall(r"\w+", imported[1]), public(text[imported.end():])


def make_types():
    """The text of nusselt-three.d.ts."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name in ("library", "three"):
            shutil.copytree(WEB / name, folder / name)
        for file in (folder / "three").glob("*.ts"):
            file.write_text(editors_comments(file.read_text()))
        shutil.copy(WEB / "tsconfig.json", folder)
        subprocess.run(["tsc", "--project", folder, "--noEmit", "false", "--declaration", "--emitDeclarationOnly", "--stripInternal",
                        "--outDir", folder / "types"], check=True)
        exported = re.findall(r'from "\./(\w+)"', (folder / "three/index.ts").read_text())
        parts = [declarations((folder / f"types/three/{name}.d.ts").read_text()) for name in exported]
    names = sorted({name for imported, _ in parts for name in imported})
    used = [name for name in names if any(re.search(rf"\b{name}\b", text) for _, text in parts)]
    return f'import {{ {", ".join(used)} }} from "three";\n' + "".join(text for _, text in parts) + "export {};\n"
