"""Entry points of shaders/parity in GLSL ES 3.00, with the flattened files of the library."""
import pathlib
import re

SHADERS = pathlib.Path(__file__).resolve().parents[2] / "shaders"
INCLUDE = re.compile(r'^#include "([^"]+)"$', re.MULTILINE)
# What is about Vulkan; WebGL has neither an fma() nor specialisation constants.
VULKAN_ONLY = re.compile(r'^#(version |extension |include "interface/fused_fma.h").*\n', re.MULTILINE)


def included(name, flattened):
    """A file of the library is the flattened one: that is what programs for WebGL copy."""
    if name.startswith("nusselt/"):
        return (flattened / pathlib.Path(name).name).read_text()
    return resolved((SHADERS / name).read_text(), flattened)


def resolved(text, flattened):
    return INCLUDE.sub(lambda match: included(match[1], flattened), VULKAN_ONLY.sub("", text))


def es_source(source, defines, flattened):
    """The text of a program that glslang compiles for Vulkan, in the dialect of WebGL 2.

    source:    the file
    defines:   such as NUSSELT_MAX_VERTICES=4
    flattened: the folder that scripts/flatten-glsl.cmake wrote
    """
    lines = ["#version 300 es", *("#define " + define.replace("=", " ", 1) for define in (*defines, "NUSSELT_UNROLL="))]
    return "\n".join(lines) + "\n" + resolved(pathlib.Path(source).read_text(), flattened)
