"""Where things are: the command and the project, which ctest names."""
import os
import subprocess
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[2]


@pytest.fixture
def example():
    return PROJECT / "examples/dof-spheres.samples.exr"


@pytest.fixture
def command():
    """Runs the command that the build made. Skipped where there is none."""
    program = os.environ.get("RPF_COMMAND")
    if not program:
        pytest.skip("RPF_COMMAND does not name the command")
    return lambda *arguments: subprocess.run([program, *map(str, arguments)], check=True, stdout=subprocess.PIPE, text=True).stdout
