"""What the tests share: paths, and lights of one kind."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SQUARE = np.array([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], np.float64)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.fixture
def square():
    return SQUARE


@pytest.fixture
def scenes():
    return ROOT / "scenes"


@pytest.fixture
def program():
    """Calls `nusselt` with arguments."""
    def run(*arguments):
        subprocess.run([os.environ["NUSSELT_PROGRAM"], *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)
    return run


def arguments_of(name, vertices=SQUARE):
    """What the class of a technique takes for a light in front of the shading point."""
    lobe = np.array([0.9, 0.1, 1, -0.1, 0.8])
    begin, end = np.array([-1, 0.2, 1]), np.array([1, -0.3, 1.5])
    axes = np.array([[0.5, 0.1, 0], [-0.1, 0.4, 0.2], [0, -0.2, 0.6]])
    rounds = {"Sphere": [begin, 0.5], "Disk": [begin, [0, 0.6, 0.8], 0.5], "Ellipsoid": [begin, axes],
              "Ellipse": [begin, axes[0], axes[1]]}
    arguments = [begin, end] if name.startswith(("Line", "Cylinder")) else [vertices]
    if name.startswith("Cylinder"):
        arguments.append(0.1)
    for shape in rounds:
        if name.startswith(shape):
            arguments = rounds[shape]
            break
    return arguments + ([lobe] if "Ltc" in name else [])
