#!/usr/bin/env python3
"""Shaders in GLSL ES 3.00 compile in WebGL 2, whose rules are stricter: no structures as operands of `?:`, and none that are
nested more than four deep.

Usage: tests/browser/shaders_test.py FOLDER    (with *.frag, see tests/shaders/check_shaders.sh)
Ends with 77 where chromium, chromium-driver or python3-selenium is missing; with CI=true in the environment, that is a
failure.
"""
import pathlib
import sys

from browser import WEBGL, Browser

MESSAGES = """
const [source] = arguments;
window.gl ??= document.createElement("canvas").getContext("webgl2");
const shader = gl.createShader(gl.FRAGMENT_SHADER);
gl.shaderSource(shader, source);
gl.compileShader(shader);
const messages = gl.getShaderParameter(shader, gl.COMPILE_STATUS) ? "" : gl.getShaderInfoLog(shader) || "does not compile";
gl.deleteShader(shader);
return messages;
"""

# Programs that a check without WebGL's rules would let pass, and what of them is allowed.
RULES = {
    "a choice between structures": ("""#version 300 es
        struct A { int a; };
        A choose(bool first, A a, A b) { return first ? a : b; }
        void main() {}""", """#version 300 es
        struct A { int a; };
        A choose(bool first, A a, A b) { if (first) return a; return b; }
        void main() {}"""),
    "structures in five levels": ("""#version 300 es
        struct A { int a; }; struct B { A a; }; struct C { B b; }; struct D { C c; };
        struct E { D d; };
        int get(E e) { return e.d.c.b.a.a; }
        void main() {}""", """#version 300 es
        struct A { int a; }; struct B { A a; }; struct C { B b; }; struct D { C c; };
        int get(D d) { return d.c.b.a.a; }
        void main() {}"""),
}


def main():
    files = sorted(pathlib.Path(sys.argv[1]).glob("*.frag"))
    assert files, f"{sys.argv[1]} has no shaders"
    browser = Browser(WEBGL)
    failed = []
    try:
        for file in files:
            messages = browser.script(MESSAGES, file.read_text())
            if messages:
                failed.append(f"{file.name}: {messages}")
        for name, (forbidden, allowed) in RULES.items():
            if not browser.script(MESSAGES, forbidden):
                failed.append(f"the browser accepts {name}: it does not check what it should")
            messages = browser.script(MESSAGES, allowed)
            if messages:
                failed.append(f"the browser rejects what should replace {name}: {messages}")
    finally:
        browser.quit()
    print("\n".join(failed) or f"{len(files)} shaders compile in WebGL 2")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
